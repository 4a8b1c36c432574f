#pragma once

// Boxes of a picture whose test is one subtraction.
//
// The picture is divided into 2^15 steps along each axis. A box is four numbers of steps, rounded outwards, in one
// word of 64 bits; upper ends are held from the other side. Between two numbers lies a bit that is 0 in a box and 1
// in a query, and stays 1 in query - box where the number of the query is not less.
//
//     box    0 low x     0 low y     0 -high x    0 -high y
//     query  1 high x    1 high y    1 -low x     1 -low y

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>

namespace rimline {

/// Floats below and above a value, by no less than rounding. (std::nextafter is a slow call.)
inline float float_below(double value) noexcept {
    const auto rounded = static_cast<float>(value);
    return rounded - ((rounded < 0.0f ? -rounded : rounded) * 0x1p-23f + 0x1p-120f);
}
inline float float_above(double value) noexcept { return -float_below(-value); }

struct PictureBox {
    std::uint64_t steps;
};
struct PictureQuery {
    std::uint64_t steps;
};

/// Whether the boxes of both may have a place in common.
inline bool may_meet(const PictureBox& box, const PictureQuery& query) noexcept {
    constexpr std::uint64_t k_between = 0x8000'8000'8000'8000u;
    return ((query.steps - box.steps) & k_between) == k_between;
}

class PictureSteps {
public:
    PictureSteps() = default;
    /// Places outside of the picture count as on its border.
    PictureSteps(const glm::dvec2& low, const glm::dvec2& high) noexcept
        : low_(low),
          steps_a_unit_(k_last_step / std::max({high.x - low.x, high.y - low.y, 1e-300})) {}

    /// Of all places within `margin` of the segment.
    PictureBox box(const glm::dvec2& a, const glm::dvec2& b, double margin) const noexcept {
        const Ends ends = ends_of(a, b, margin);
        return {ends.low_x << 48 | ends.low_y << 32 | (k_last - ends.high_x) << 16 |
                (k_last - ends.high_y)};
    }
    PictureQuery query(const glm::dvec2& a, const glm::dvec2& b) const noexcept {
        const Ends ends = ends_of(a, b, 0.0);
        return {(ends.high_x | k_bit) << 48 | (ends.high_y | k_bit) << 32 |
                ((k_last - ends.low_x) | k_bit) << 16 | ((k_last - ends.low_y) | k_bit)};
    }

private:
    static constexpr double k_last_step = 32'767.0;
    static constexpr std::uint64_t k_last = 32'767, k_bit = 0x8000;
    static constexpr double k_slack = 1e-6;  // Of a step: far above rounding errors.

    struct Ends {
        std::uint64_t low_x, low_y, high_x, high_y;
    };
    Ends ends_of(const glm::dvec2& a, const glm::dvec2& b, double margin) const noexcept {
        const auto step = [&](double value, double origin, double slack) {
            return static_cast<std::uint64_t>(
                std::clamp((value - origin) * steps_a_unit_ + slack, 0.0, k_last_step));
        };
        return {step(std::min(a.x, b.x) - margin, low_.x, -k_slack),
                step(std::min(a.y, b.y) - margin, low_.y, -k_slack),
                step(std::max(a.x, b.x) + margin, low_.x, k_slack),
                step(std::max(a.y, b.y) + margin, low_.y, k_slack)};
    }

    glm::dvec2 low_{0.0};
    double steps_a_unit_ = 1.0;
};

}  // namespace rimline
