#pragma once

// The v-sphere of a silhouette point, and on which side of it a box of Hough points certainly lies.
//
// With q = p - w*O the v-sphere has the poles 0 and q (thesis 3.2; a direction makes it the plane
// H·q = 0), and for the foot point H of a plane (n, d)
//
//     g(H) = w|H|² - H·q = (dO/|n|²)(w*dO - n·q),        n·q - w*dO = n·p - w*d  exactly.
//
// So the real value whose sign the face bit rounds is -g(H)|n|²/dO: for dO > 0 a face is front when H
// lies inside the v-sphere (g < 0), for dO < 0 when it lies outside.
//
// When is the rounded bit certain? With u = 2^-24 its three products and two sums err by at most
// 3u(1 + 3u)·Σ|n_i p_i| <= 3.1u|n||p|; nothing is subnormal (plane.h) and w*d and the comparison are
// exact. As |dO| = |H||n|, the bit is that of the real value wherever
//
//     |g(H)| > 3.1u |p| |H|.
//
// `side_of` evaluates bounds of g over a box in float as well. With q rounded once, each term h(wh - q)
// takes two roundings and their sum two more: at most 4.1u|H|(|H| + |q|) + u|H||q|, and 2^-149 a term
// where products are subnormal. So it asks for
//
//     |g| > reach * (4u|p| + 6u(|q| + R)) + 2^-140
//
// where reach >= |H| for all of the box and R bounds the reach of all boxes; what the constants leave
// covers the roundings of the margin itself. A few u cost no culling: boxes are thousands of u wide.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/rounded_float.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// An axis-aligned box of Hough points, rounded outward to floats. Empty until something is included.
/// Four lanes, the last of a filled box zero, so that a box is two vector registers.
struct HoughBox {
    using Lanes = std::array<float, 4>;
    static constexpr float k_infinity = std::numeric_limits<float>::infinity();

    Lanes low{k_infinity, k_infinity, k_infinity, 0.0f};
    Lanes high{-k_infinity, -k_infinity, -k_infinity, 0.0f};

    /// With all that its error bound allows.
    void include(const HoughPoint& point) noexcept {
        for (std::size_t i = 0; i < 3; ++i) {
            const double position = point.position[static_cast<int>(i)];
            low[i] = std::min(low[i], rounded_down(position - point.error));
            high[i] = std::max(high[i], rounded_up(position + point.error));
        }
    }
    void include(const HoughBox& box) noexcept {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], box.low[i]);
            high[i] = std::max(high[i], box.high[i]);
        }
    }
    bool is_empty() const noexcept { return !(low[0] <= high[0]); }

    /// The distance of the farthest corner from the origin of Hough space, rounded up; 0 when empty.
    float reach() const noexcept {
        if (is_empty()) return 0.0f;
        double squares = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double farthest = std::max(-double{low[i]}, double{high[i]});
            squares += farthest * farthest;
        }
        return rounded_up(std::sqrt(squares) * (1.0 + 0x1p-50));
    }
};

/// On which side all planes of a box lie, so far that each face's bit is certain; or that it is not.
enum class VSphereSide : std::uint8_t { mixed, inside, outside };

class VSphere {
public:
    /// `greatest_reach` bounds the reach of every box that will be asked about.
    VSphere(const HomogeneousPoint& point, const glm::dvec3& origin, float greatest_reach) noexcept
        : w_(point.w) {
        const glm::dvec3 p(point.xyz());
        const glm::dvec3 q = p - double{w_} * origin;
        for (std::size_t i = 0; i < 3; ++i) {
            q_[i] = static_cast<float>(q[static_cast<int>(i)]);
            // Of h(wh - q): where the parabola is least, or beyond the end where the line is.
            min_at_[i] = w_ != 0.0f ? 0.5f * q_[i] : std::copysign(HoughBox::k_infinity, q_[i]);
        }
        margin_ = static_cast<float>(0x1p-22 * glm::length(p) +
                                     0x6p-24 * (glm::length(q) + double{greatest_reach}));
        smallest_margin_ = 0x1p-140f;
    }

    /// The same without any margin: for tests, which show that without it bits are wrong.
    VSphere without_margin() const noexcept {
        VSphere sphere = *this;
        sphere.margin_ = 0.0f;
        sphere.smallest_margin_ = 0.0f;
        return sphere;
    }

    /// `reach` is the box's. The box must not be empty.
    VSphereSide side_of(const HoughBox& box, float reach) const noexcept {
        HoughBox::Lanes least;
        HoughBox::Lanes greatest;
        for (std::size_t i = 0; i < 4; ++i) {
            const float low = box.low[i];
            const float high = box.high[i];
            float at = min_at_[i] > low ? min_at_[i] : low;
            at = at < high ? at : high;
            const float at_low = low * (w_ * low - q_[i]);
            const float at_high = high * (w_ * high - q_[i]);
            least[i] = at * (w_ * at - q_[i]);
            greatest[i] = at_low > at_high ? at_low : at_high;
        }
        const float margin = margin_ * reach + smallest_margin_;
        if (greatest[0] + greatest[1] + greatest[2] < -margin) return VSphereSide::inside;
        return least[0] + least[1] + least[2] > margin ? VSphereSide::outside : VSphereSide::mixed;
    }

private:
    float w_;
    HoughBox::Lanes q_{};
    HoughBox::Lanes min_at_{};
    float margin_;           // Times a box's reach, and
    float smallest_margin_;  // this: how far g must be from zero.
};

}  // namespace rimline
