#pragma once

// How much the pictures of two line paths may differ on a device.
//
// All paths evaluate the same expressions (shaders/capsule.glsl), in different stages. On Mesa's lavapipe one compiler
// makes all stages, the results have the same bits, and the pictures must be equal. Other compilers may contract and
// reassociate what `precise` does not protect. Then the ends of a capsule differ by some units in the last place: less
// than 2^-10 of a pixel in pictures up to 4096 pixels wide, and coverage by as much. With the rounding to half
// floats and to bytes on the way this is at most two levels of 255. Decisions can turn, too: whether a point of a line
// is hidden, on which side its faces are. Each turns single pixels entirely, and only where a value is within
// rounding of its limit. The bound allows one pixel in a thousand.
//
// This was derived, and not yet measured on a GPU.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstdlib>

#include "silhouette/picture.h"

namespace rimline::tests {

struct LinePathBound {
    int levels = 0;            ///< Of 255, in every channel of a pixel that counts as equal.
    double share = 0.0;        ///< Of all pixels: those that may differ by more.
    double mean_levels = 0.0;  ///< The mean over all channels of all pixels may be as much.
};

/// Zero for Mesa's lavapipe.
inline LinePathBound line_path_bound(VkDriverId driver) noexcept {
    if (driver == VK_DRIVER_ID_MESA_LLVMPIPE) return {};
    return {.levels = 2, .share = 1e-3, .mean_levels = 0.05};
}

/// Whether pictures of the same size differ by no more. O(pixels).
inline bool differ_within(const Picture& a, const Picture& b, const LinePathBound& bound) {
    if (a.width != b.width || a.height != b.height || a.rgba.size() != b.rgba.size()) return false;
    std::uint64_t sum = 0;
    std::uint64_t beyond = 0;
    for (std::size_t pixel = 0; pixel < a.rgba.size(); pixel += 4) {
        bool is_beyond = false;
        for (std::size_t c = pixel; c < pixel + 4; ++c) {
            const int levels = std::abs(int(a.rgba[c]) - int(b.rgba[c]));
            sum += static_cast<std::uint64_t>(levels);
            is_beyond |= levels > bound.levels;
        }
        beyond += is_beyond;
    }
    const auto channels = static_cast<double>(a.rgba.size());
    return double(beyond) <= bound.share * channels / 4.0 &&
           double(sum) <= bound.mean_levels * channels;
}

}  // namespace rimline::tests
