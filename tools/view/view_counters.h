#pragma once

// How the last frames went, for the panel.

#include <array>
#include <cstddef>

#include "engine/renderer.h"
#include "tools/view/cloud_document.h"

namespace rimline::tools {

struct ViewCounters {
    static constexpr std::size_t k_times = 120;

    FrameReport report;                  ///< Of the frame drawn last, of a model.
    CloudReport cloud;                   ///< The same of a cloud.
    std::array<float, k_times> times{};  ///< Of frames, in ms; the oldest at `next`.
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

}  // namespace rimline::tools
