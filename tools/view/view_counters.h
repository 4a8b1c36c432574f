#pragma once

// Counters and times of the last frames, shown in the panel.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "engine/renderer.h"
#include "tools/view/cloud_document.h"

namespace rimline::tools {

struct ViewCounters {
    static constexpr std::size_t k_times = 120;

    FrameReport report;                  ///< The last frame, if it shows a model.
    CloudReport cloud;                   ///< The last frame, if it shows a cloud.
    std::array<float, k_times> times{};  ///< Frame times in ms. The oldest is at `next`.
    std::size_t next = 0;
    std::size_t frames = 0;

    void add(const FrameReport& drawn, double time_ms) noexcept {
        report = drawn;
        times[next] = static_cast<float>(time_ms);
        next = (next + 1) % k_times;
        ++frames;
    }
    float last_ms() const noexcept { return times[(next + k_times - 1) % k_times]; }
};

/// The name of a pass (PassTime) with its light counted from 1, as in the panel.
inline std::string shown_pass_name(const std::string& name) {
    constexpr std::string_view k_before = ", light ";
    const std::size_t at = name.rfind(k_before);
    if (at == std::string::npos) return name;
    const std::size_t number = at + k_before.size();
    return name.substr(0, number) + std::to_string(std::stoul(name.substr(number)) + 1);
}

}  // namespace rimline::tools
