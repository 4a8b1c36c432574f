#pragma once

// The v-sphere of a silhouette point, and the test on which side of it a box of Hough points certainly lies.
//
// With q = p - w*O the v-sphere has the poles 0 and q (thesis 3.2; a direction makes it the plane
// H·q = 0), and for the foot point H of a plane (n, d)
//
//     g(H) = w|H|² - H·q = (dO/|n|²)(w*dO - n·q),        n·q - w*dO = n·p - w*d  exactly.
//
// So the face bit is the sign of the real value -g(H)|n|²/dO, but for rounding. For dO > 0 a face is front
// when H lies inside the v-sphere (g < 0); for dO < 0 when it lies outside.
//
// The rounded bit: with u = 2^-24 its three products and two sums err by at most
// 3u(1 + 3u)·Σ|n_i p_i| <= 3.1u|n||p|. Nothing is subnormal (silhouette/mesh/plane.h), and w*d and the
// comparison are exact. As |dO| = |H||n|, the bit is that of the real value wherever
//
//     |g(H)| > 3.1u |p| |H|.
//
// `side_of` computes bounds of g over a box, also in float. With q rounded once, each term h(wh - q) has two
// roundings and their sum two more: at most 4.1u|H|(|H| + |q|) + u|H||q|, and 2^-149 a term where products
// are subnormal. So it requires
//
//     |g| > reach * (4u|p| + 6u(|q| + R)) + 2^-140
//
// where reach >= |H| for the whole box and R is an upper bound of the reach of all boxes. The constants are
// rounded up enough for the roundings of the margin itself. This costs no culling: boxes are thousands of u
// wide.

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
/// It has four lanes, so that a box is two vector registers. The last lane of a box that is not empty is
/// zero.
struct HoughBox {
    using Lanes = std::array<float, 4>;
    static constexpr float k_infinity = std::numeric_limits<float>::infinity();

    Lanes low{k_infinity, k_infinity, k_infinity, 0.0f};
    Lanes high{-k_infinity, -k_infinity, -k_infinity, 0.0f};

    /// Includes the point with its error bound.
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

    /// The maximum distance of a corner from the origin of Hough space, rounded up; 0 when empty.
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

/// The side on which all Hough points of a box lie, where each face's bit is certain; else mixed.
enum class VSphereSide : std::uint8_t { mixed, inside, outside };

class VSphere {
public:
    /// `max_reach` is an upper bound of the reach of every box that is tested.
    VSphere(const HomogeneousPoint& point, const glm::dvec3& origin, float max_reach) noexcept
        : w_(point.w) {
        const glm::dvec3 p(point.xyz());
        const glm::dvec3 q = p - double{w_} * origin;
        for (std::size_t i = 0; i < 3; ++i) {
            q_[i] = static_cast<float>(q[static_cast<int>(i)]);
            // The h at which h(wh - q) is minimal: the vertex of the parabola, or an infinity for a line.
            min_at_[i] = w_ != 0.0f ? 0.5f * q_[i] : std::copysign(HoughBox::k_infinity, q_[i]);
        }
        margin_ = static_cast<float>(0x1p-22 * glm::length(p) +
                                     0x6p-24 * (glm::length(q) + double{max_reach}));
        smallest_margin_ = 0x1p-140f;
    }

    /// The same without margin. For tests, which show that bits are wrong without it.
    VSphere without_margin() const noexcept {
        VSphere sphere = *this;
        sphere.margin_ = 0.0f;
        sphere.smallest_margin_ = 0.0f;
        return sphere;
    }

    /// `reach` is the box's. The box must not be empty.
    VSphereSide side_of(const HoughBox& box, float reach) const noexcept {
        HoughBox::Lanes minimum;
        HoughBox::Lanes maximum;
        for (std::size_t i = 0; i < 4; ++i) {
            const float low = box.low[i];
            const float high = box.high[i];
            float at = min_at_[i] > low ? min_at_[i] : low;
            at = at < high ? at : high;
            const float at_low = low * (w_ * low - q_[i]);
            const float at_high = high * (w_ * high - q_[i]);
            minimum[i] = at * (w_ * at - q_[i]);
            maximum[i] = at_low > at_high ? at_low : at_high;
        }
        const float margin = margin_ * reach + smallest_margin_;
        if (maximum[0] + maximum[1] + maximum[2] < -margin) return VSphereSide::inside;
        return minimum[0] + minimum[1] + minimum[2] > margin ? VSphereSide::outside
                                                             : VSphereSide::mixed;
    }

private:
    float w_;
    HoughBox::Lanes q_{};
    HoughBox::Lanes min_at_{};
    // |g| must be above margin_ * reach + smallest_margin_.
    float margin_;
    float smallest_margin_;
};

}  // namespace rimline
