#include "tools/command.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

namespace rimline::tools {

namespace {

bool g_is_quiet = false;

void print_message(const char* kind, std::string message) {
    while (!message.empty() && message.back() == '\n') message.pop_back();
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::fflush(stdout);
    std::fprintf(stderr, "rimline: %s: %s\n", kind, message.c_str());
}

}  // namespace

void print_error(std::string message) { print_message("error", std::move(message)); }

void print_warning(std::string message) {
    if (!g_is_quiet) print_message("warning", std::move(message));
}

void be_quiet() noexcept { g_is_quiet = true; }
bool is_quiet() noexcept { return g_is_quiet; }

ExitStatus report_check(const std::string& failure) {
    if (failure.empty()) return ExitStatus::success;
    print_error(failure);
    return ExitStatus::check_failed;
}

void print_json(const Context& context, nlohmann::ordered_json object) {
    object["times_ms"] = context.times.json();
    print_json(object);
}

void print_json(const nlohmann::ordered_json& object) {
    const std::string text = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fputc('\n', stdout);
}

}  // namespace rimline::tools
