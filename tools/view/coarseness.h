#pragma once

// How coarse the frames of a moving picture are, so that they answer the user in time.
//
// On a slow device they have fewer faces, where there are many (reduced_model.h). Frames that take longer than
// k_slow_ms make the next one coarser: first fewer pixels, then no shadows. Frames that take less than k_fast_ms make
// it finer, but not soon after a finer one was too slow. An event that arrives just after a frame has begun is shown by
// the next one, so it is answered within twice k_slow_ms, unless the coarsest frames take longer. At rest the picture
// is drawn finely, whatever that takes; an event gives it up (window_renderer.h), so that its answer waits for the
// passes that the device is at.

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
    static constexpr double k_slow_ms = 45.0;
    static constexpr double k_fast_ms = 22.0;  // More than 20: a frame of a display of 50 Hz.

    /// Of a moving picture. On a device that is not slow the first level is as fine as at rest.
    explicit Coarseness(bool is_slow_device)
        : is_slow_device_(is_slow_device), level_(is_slow_device ? 1 : 0) {}

    bool is_slow_device() const noexcept { return is_slow_device_; }
    const FrameQuality& quality() const noexcept { return k_levels[level_]; }

    /// Adapts to what a frame of a picture at rest took: on a slow device the next movement begins at the coarsest
    /// level if it was slow, so that its first frames do not have to be slow before.
    void add_fine(double frame_ms) noexcept {
        if (is_slow_device_ && frame_ms > k_slow_fine_ms) level_ = k_levels.size() - 1;
    }
    /// Adapts to what a frame of quality() took.
    void add(double frame_ms) noexcept {
        if (patience_ > 0) --patience_;
        if (frame_ms > k_slow_ms && level_ + 1 < k_levels.size()) {
            ++level_;
            patience_ = k_patience;
        } else if (frame_ms < k_fast_ms && level_ > 0 && patience_ == 0) {
            --level_;
        }
    }

private:
    static constexpr std::array<FrameQuality, 5> k_levels{
        {{0, 1, true}, {1, 1, true}, {1, 2, true}, {1, 3, true}, {1, 3, false}}};
    static constexpr int k_patience = 60;  // Frames.
    // The first coarse level takes half to two thirds of a fine frame (horse, Nefertiti, ogre; lavapipe).
    static constexpr double k_slow_fine_ms = 2.0 * k_slow_ms;
    bool is_slow_device_;
    std::size_t level_;
    int patience_ = 0;
};

}  // namespace rimline::tools
