#include "tools/run_times.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace rimline::tools {

namespace {

std::string as_seconds(double ms) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f", 1e-3 * ms);
    return text.data();
}

}  // namespace

void RunTimes::end(const std::string& name) {
    const Clock::time_point now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    const auto same = std::ranges::find(steps_, name, &Step::name);
    if (same != steps_.end())
        same->ms += ms;
    else
        steps_.push_back({name, ms});
}

double RunTimes::total_ms() const noexcept {
    return std::chrono::duration<double, std::milli>(last_ - started_).count();
}

nlohmann::ordered_json RunTimes::json() const {
    // Not made an object by its first element: if that cannot be allocated, nlohmann's destructor crashes.
    auto object = nlohmann::ordered_json::object();
    for (const Step& step : steps_) object[step.name] = step.ms;
    object["total"] = total_ms();
    return object;
}

std::string RunTimes::table() const {
    std::string text;
    const auto add = [&](const std::string& name, double ms) {
        std::array<char, 96> line{};
        std::snprintf(line.data(), line.size(), "  %-20s %9.3f s\n", name.c_str(), 1e-3 * ms);
        text += line.data();
    };
    for (const Step& step : steps_) add(step.name, step.ms);
    add("in all", total_ms());
    return text;
}

std::string RunTimes::sentence() const {
    constexpr double k_least_ms = 5.0;
    std::string text = as_seconds(total_ms()) + " s";
    const char* before = ": ";
    for (const Step& step : steps_) {
        if (step.ms < k_least_ms) continue;
        text += before + step.name + " " + as_seconds(step.ms);
        before = ", ";
    }
    return text;
}

}  // namespace rimline::tools
