#pragma once

// The box of a segment of a picture, in float and rounded outwards: a test of two boxes is four comparisons.

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace rimline {

/// Floats below and above a value, by no less than rounding. (std::nextafter is a slow call.)
inline float float_below(double value) noexcept {
    const auto rounded = static_cast<float>(value);
    return rounded - (std::abs(rounded) * 0x1p-23f + 0x1p-120f);
}
inline float float_above(double value) noexcept { return -float_below(-value); }

struct PictureBox {
    float low_x, low_y, high_x, high_y;

    /// All places within `margin` of the segment.
    static PictureBox around(const glm::dvec2& a, const glm::dvec2& b, double margin) noexcept {
        return {float_below(std::min(a.x, b.x) - margin), float_below(std::min(a.y, b.y) - margin),
                float_above(std::max(a.x, b.x) + margin), float_above(std::max(a.y, b.y) + margin)};
    }
    /// Without branches, which would be mispredicted.
    bool meets(const PictureBox& other) const noexcept {
        return (int(low_x <= other.high_x) & int(other.low_x <= high_x) &
                int(low_y <= other.high_y) & int(other.low_y <= high_y)) != 0;
    }
};

}  // namespace rimline
