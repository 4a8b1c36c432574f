#pragma once

// Boxes of the lines of a picture, of which a block is compared at once.
//
// The picture and its depths are divided into 2^15 steps along each axis. A box is rounded outwards to whole steps.

#include <algorithm>
#include <array>
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

/// A block of boxes.
struct alignas(64) PictureBoxes {
    static constexpr std::size_t k_boxes = 32;
    std::array<std::int16_t, k_boxes> low_x, low_y, high_x, high_y, near;

    void set(std::size_t k, const PictureBox& box) noexcept {
        low_x[k] = box.low_x;
        low_y[k] = box.low_y;
        high_x[k] = box.high_x;
        high_y[k] = box.high_y;
        near[k] = box.near;
    }
};

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
