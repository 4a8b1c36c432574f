#pragma once

// How coarse the frames of a moving picture are, so that they answer the user in time.
//
// Frames that take longer than k_slow_ms make the next one coarser, and frames that take less than k_fast_ms
// make it finer: first fewer pixels, then no shadows. At rest the picture is drawn finely, whatever that takes.

#include <array>
#include <cstddef>
#include <cstdint>

namespace rimline::tools {

struct FrameQuality {
    std::uint32_t scale = 0;    ///< RendererOptions::scale; 0: the device's own.
    std::uint32_t divisor = 1;  ///< Pixels of the window, along each side, for one that is drawn.
    bool shadows = true;
};

class Coarseness {
public:
    static constexpr double k_slow_ms = 90.0;
    static constexpr double k_fast_ms = 30.0;

    /// Of a moving picture. On a device that is not slow the first level is as fine as at rest.
    explicit Coarseness(bool is_slow_device) : level_(is_slow_device ? 1 : 0) {}

    const FrameQuality& quality() const noexcept { return k_levels[level_]; }
    /// Adapts to what a frame of quality() took.
    void add(double frame_ms) noexcept {
        if (frame_ms > k_slow_ms && level_ + 1 < k_levels.size()) ++level_;
        // Twice as fine takes four times as long: the gap between the limits keeps it from flickering.
        if (frame_ms < k_fast_ms && level_ > 0) --level_;
    }

private:
    static constexpr std::array<FrameQuality, 5> k_levels{
        {{0, 1, true}, {1, 1, true}, {1, 2, true}, {1, 3, true}, {1, 3, false}}};
    std::size_t level_;
};

}  // namespace rimline::tools
