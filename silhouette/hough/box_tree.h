#pragma once

// A tree over blocks in octree order (octree_order.h). Eight neighboring blocks make a node, and eight
// neighboring nodes make a node of the next level. There are no pointers: children of node i of a level are
// 8i to 8i + 7 of the level below. Below the last level are the blocks.
//
//     level 0   [ root                                  ]
//     level 1   [ 0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 ]
//     blocks    [ 0 .. 7 | 8 .. 15 | ...        | 56 .. ]
//
// A node holds the boxes of its children as structure of arrays, with one vector register for each bound. One
// sequence of instructions tests all eight against a v-sphere. Boxes are centers and extents.
// For a box c ± e and h = c + x, |x| <= e, each axis of g (v_sphere.h) is
//
//     h(wh - q) = c(wc - q) + x(2wc - q) + wx²
//
// so with V = Σ c(wc - q) and R = Σ e(|2wc - q| + we), g lies in [V - R, V + R]. (The lower bound is too low
// by Σ we², which is negligible for boxes small against the v-sphere.) In float V and R err by at most
// 2^-24 * reach * (13|q| + 22 reach), where reach is at least |h| in the box. A bit is certain where
// |g| > 3.1 * 2^-24 |p| reach. So a box is certainly on one side if |V| > R + margin, with
//
//     margin = reach * (4 * 2^-24 |p| + 32 * 2^-24 (|q| + max_reach)) + 2^-140.

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

/// Lanes beyond the last child are NaN: all comparisons with them are false.
struct alignas(64) BoxNode {
    float center[3][k_node_width];
    float extent[3][k_node_width];
    float reach[k_node_width];
};

/// A box of Hough points in double, empty until something is included.
struct HoughBounds {
    std::array<double, 3> low{1e300, 1e300, 1e300};
    std::array<double, 3> high{-1e300, -1e300, -1e300};

    /// Includes the point with its error bound.
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
    /// `blocks` must not hold an empty box. O(blocks) on all threads.
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
    /// Upper bound of |H| in all boxes.
    float max_reach() const noexcept { return max_reach_; }
    /// The mean over all blocks of half the diagonal of the box.
    double mean_block_radius() const noexcept { return mean_block_radius_; }

private:
    std::vector<BoxNode> nodes_;
    std::vector<std::uint32_t> level_begin_{0};
    std::uint32_t block_count_ = 0;
    float max_reach_ = 0.0f;
    double mean_block_radius_ = 0.0;
};

/// A v-sphere, prepared for tests of nodes: |V| <= R + reach * margin + min_margin means mixed.
struct BoxQuery {
    /// The v-sphere of `point`.
    BoxQuery(const HomogeneousPoint& point, const glm::dvec3& origin, float max_reach) noexcept;
    /// A thick v-sphere for two points of equal w. A box that lies certainly on one side of it lies on the
    /// same side of both v-spheres and of all between: for these, g differs by at most |H||q - q'|/2 from g
    /// of the midpoint.
    static BoxQuery between(const HomogeneousPoint& from, const HomogeneousPoint& to,
                            const glm::dvec3& origin, float max_reach) noexcept;

    float w;
    float q[3];
    float margin;
    float min_margin = 0x1p-140f;

private:
    BoxQuery() = default;
};

/// Whether one test against the thick v-sphere between the points is faster than two tests
/// (BoxQuery::between).
bool is_small_step(const HomogeneousPoint& from, const HomogeneousPoint& to,
                   const BoxTree& tree) noexcept;

}  // namespace rimline
