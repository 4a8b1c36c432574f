#include "tools/command.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "silhouette/printable_text.h"

namespace rimline::tools {

namespace {

bool g_is_quiet = false;

void print_message(const char* kind, std::string_view message) {
    while (message.ends_with('\n')) message.remove_suffix(1);
    std::fflush(stdout);
    try {
        std::string line(message);
        std::ranges::replace(line, '\n', ' ');
        std::fprintf(stderr, "rimline: %s: %s\n", kind, printable_text(line).c_str());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "rimline: %s: ", kind);
        for (const char c : message) std::fputc(c >= ' ' && c < 0x7f ? c : '?', stderr);
        std::fputc('\n', stderr);
    }
}

using Json = nlohmann::ordered_json;

// `value` with all its strings and keys in UTF-8.
Json in_utf8(const Json& value) {
    if (value.is_string()) return printable_text(value.get_ref<const std::string&>());
    if (!value.is_structured()) return value;
    Json result = value.is_array() ? Json::array() : Json::object();
    for (const auto& [key, element] : value.items()) {
        if (value.is_array())
            result.push_back(in_utf8(element));
        else
            result[printable_text(key)] = in_utf8(element);
    }
    return result;
}

void write_json(const Json& value) { print_text(json_text(value)); }

void write_list(const JsonList& list) {
    print_text("[");
    for (std::size_t i = 0; i < list.count; ++i) {
        if (i > 0) print_text(",");
        write_json(list.element(i));
    }
    print_text("]");
}

}  // namespace

void print_error(std::string_view message) { print_message("error", message); }

void print_warning(std::string_view message) {
    if (!g_is_quiet) print_message("warning", message);
}

void be_quiet() noexcept { g_is_quiet = true; }
bool is_quiet() noexcept { return g_is_quiet; }

ExitStatus report_check(const std::string& failure) {
    if (failure.empty()) return ExitStatus::success;
    print_error(failure);
    return ExitStatus::check_failed;
}

void print_text(std::string_view text) {
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size()) return;
    throw Error(ErrorCode::io,
                "standard output: cannot write: " + std::generic_category().message(errno));
}

std::string json_text(const Json& object) {
    try {
        return object.dump();
    } catch (const Json::type_error&) {
        return in_utf8(object).dump();
    }
}

void print_json(const Json& object) {
    write_json(object);
    print_text("\n");
}

void print_json(const Context& context, Json object) {
    object["times_ms"] = context.times.json();
    print_json(object);
}

void print_json(const Context& context, Json object, const JsonList& list) {
    object["times_ms"] = context.times.json();
    std::string_view separator = "{";
    for (const auto& [key, value] : object.items()) {
        print_text(separator);
        separator = ",";
        write_json(key);
        print_text(":");
        if (key == list.key)
            write_list(list);
        else
            write_json(value);
    }
    print_text("}\n");
}

}  // namespace rimline::tools
