#pragma once

// A tree over blocks in octree order (octree_order.h): eight neighboring blocks make a node, eight
// neighboring nodes the next, without pointers. Children of node i of a level are 8i to 8i + 7 of the
// level below; below the last level are the blocks.
//
//     level 0   [ root                                  ]
//     level 1   [ 0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 ]
//     blocks    [ 0 .. 7 | 8 .. 15 | ...        | 56 .. ]
//
// A node holds the boxes of its children as structure of arrays: one vector register a bound, and all
// eight are tested against a v-sphere by one sequence of instructions. Boxes are centers and extents.
// For a box c ± e and h = c + x, |x| <= e, each axis of g (v_sphere.h) is
//
//     h(wh - q) = c(wc - q) + x(2wc - q) + wx²
//
// so that with V = Σ c(wc - q) and R = Σ e(|2wc - q| + we), g lies in [V - R, V + R]. (The lower bound
// gives away Σ we², which is nothing for boxes small against the v-sphere.) In float V and R err by at
// most 2^-24 * reach * (13|q| + 22 reach), reach no less than |h| in the box; a bit is certain where
// |g| > 3.1 * 2^-24 |p| reach. So a box is certainly on one side if |V| > R + margin, with
//
//     margin = reach * (4 * 2^-24 |p| + 32 * 2^-24 (|q| + greatest reach)) + 2^-140.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/hough/hough_point.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

constexpr std::uint32_t k_node_width = 8;

/// Lanes beyond the last child are NaN: no comparison holds for them.
struct alignas(64) BoxNode {
    float center[3][k_node_width];
    float extent[3][k_node_width];
    float reach[k_node_width];
};

/// A box of Hough points in double, empty until something is included.
struct HoughBounds {
    std::array<double, 3> low{1e300, 1e300, 1e300};
    std::array<double, 3> high{-1e300, -1e300, -1e300};

    /// With all that its error bound allows.
    void include(const HoughPoint& point) noexcept {
        for (std::size_t i = 0; i < 3; ++i) {
            const double position = point.position[static_cast<int>(i)];
            low[i] = std::min(low[i], position - point.error);
            high[i] = std::max(high[i], position + point.error);
        }
    }
    void include(const HoughBounds& other) noexcept {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], other.low[i]);
            high[i] = std::max(high[i], other.high[i]);
        }
    }
    bool is_empty() const noexcept { return !(low[0] <= high[0]); }
};

class BoxTree {
public:
    BoxTree() = default;
    /// `blocks` must not hold an empty box. On all threads.
    explicit BoxTree(std::vector<HoughBounds> blocks);

    std::uint32_t block_count() const noexcept { return block_count_; }
    std::uint32_t level_count() const noexcept {
        return static_cast<std::uint32_t>(level_begin_.size()) - 1;
    }
    std::span<const BoxNode> level(std::uint32_t level) const noexcept {
        return std::span(nodes_).subspan(level_begin_[level],
                                         level_begin_[level + 1] - level_begin_[level]);
    }
    std::uint32_t node_count() const noexcept { return static_cast<std::uint32_t>(nodes_.size()); }
    /// Bounds |H| in all boxes.
    float greatest_reach() const noexcept { return greatest_reach_; }
    /// Half the diagonal of a block's box, the mean.
    double mean_block_radius() const noexcept { return mean_block_radius_; }

private:
    std::vector<BoxNode> nodes_;
    std::vector<std::uint32_t> level_begin_{0};
    std::uint32_t block_count_ = 0;
    float greatest_reach_ = 0.0f;
    double mean_block_radius_ = 0.0;
};

/// A v-sphere as nodes are tested against it: |V| <= R + reach * margin + min_margin means mixed.
struct BoxQuery {
    /// What `point` sees.
    BoxQuery(const HomogeneousPoint& point, const glm::dvec3& origin,
             float greatest_reach) noexcept;
    /// What lies certainly on one side of this one lies on the same side of both, and of all between:
    /// between two points of equal w, g is at most |H||q - q'|/2 away from that of the middle.
    static BoxQuery between(const HomogeneousPoint& from, const HomogeneousPoint& to,
                            const glm::dvec3& origin, float greatest_reach) noexcept;

    float w;
    float q[3];
    float margin;
    float min_margin = 0x1p-140f;

private:
    BoxQuery() = default;
};

/// Whether moving from one to the other is better asked of the one thick v-sphere between them than of two.
bool is_small_step(const HomogeneousPoint& from, const HomogeneousPoint& to,
                   const BoxTree& tree) noexcept;

}  // namespace rimline
