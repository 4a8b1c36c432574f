#pragma once

// Boxes of the lines of a picture, of which eight are compared at once.
//
// The picture and its depths are divided into 2^15 steps along each axis. A box is rounded outwards to whole steps.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

namespace rimline {

struct PictureBox {
    std::int16_t low_x, low_y, high_x, high_y;
    std::int16_t near, far;  ///< Of the depth.

    void include(const PictureBox& other) noexcept {
        low_x = std::min(low_x, other.low_x);
        low_y = std::min(low_y, other.low_y);
        high_x = std::max(high_x, other.high_x);
        high_y = std::max(high_y, other.high_y);
        near = std::min(near, other.near);
        far = std::max(far, other.far);
    }
};

/// The one that is nowhere: it meets nothing, and changes no box that includes it.
constexpr PictureBox k_empty_picture_box{
    std::numeric_limits<std::int16_t>::max(), std::numeric_limits<std::int16_t>::max(),
    std::numeric_limits<std::int16_t>::min(), std::numeric_limits<std::int16_t>::min(),
    std::numeric_limits<std::int16_t>::max(), std::numeric_limits<std::int16_t>::min()};

struct EightPictureBoxes {
    std::array<std::int16_t, 8> low_x, low_y, high_x, high_y, near;

    void set(std::size_t k, const PictureBox& box) noexcept {
        low_x[k] = box.low_x;
        low_y[k] = box.low_y;
        high_x[k] = box.high_x;
        high_y[k] = box.high_y;
        near[k] = box.near;
    }
};

/// Bit k: box k meets the box in the picture, and its nearest depth is not behind the farthest of the box.
inline std::uint32_t may_lie_before(const EightPictureBoxes& eight,
                                    const PictureBox& box) noexcept {
    std::array<std::int16_t, 8> does;
    for (std::size_t k = 0; k < 8; ++k)  // Becomes a few instructions on vectors.
        does[k] = static_cast<std::int16_t>(
            int(eight.low_x[k] <= box.high_x) & int(eight.low_y[k] <= box.high_y) &
            int(eight.high_x[k] >= box.low_x) & int(eight.high_y[k] >= box.low_y) &
            int(eight.near[k] <= box.far));
    // The product's highest number is the sum of four, each times its power of two.
    constexpr std::uint64_t k_powers = 0x0001'0002'0004'0008u;
    static_assert(std::endian::native == std::endian::little);
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(does);
    return static_cast<std::uint32_t>((halves[0] * k_powers >> 48) |
                                      (halves[1] * k_powers >> 48 << 4));
}

class PictureSteps {
public:
    PictureSteps() = default;
    /// Between two places: x and y of the picture, and the depth. What lies outside counts as on the border.
    PictureSteps(const glm::dvec3& low, const glm::dvec3& high) noexcept : low_(low) {
        for (int i = 0; i < 3; ++i)
            steps_a_unit_[i] = k_last_step / std::max(high[i] - low[i], 1e-300);
    }

    /// Of all places that are within `margin` of a segment along x and y.
    PictureBox box(const glm::dvec3& a, const glm::dvec3& b, double margin = 0.0) const noexcept {
        const auto step = [&](double value, int axis, double slack) {
            return static_cast<std::int16_t>(
                std::clamp((value - low_[axis]) * steps_a_unit_[axis] + slack, 0.0, k_last_step));
        };
        return {step(std::min(a.x, b.x) - margin, 0, -k_slack),
                step(std::min(a.y, b.y) - margin, 1, -k_slack),
                step(std::max(a.x, b.x) + margin, 0, k_slack),
                step(std::max(a.y, b.y) + margin, 1, k_slack),
                step(std::min(a.z, b.z), 2, -k_slack),
                step(std::max(a.z, b.z), 2, k_slack)};
    }

private:
    static constexpr double k_last_step = 32'767.0;
    static constexpr double k_slack = 1e-6;  // Of a step: far above rounding errors.

    glm::dvec3 low_{0.0}, steps_a_unit_{1.0};
};

}  // namespace rimline
