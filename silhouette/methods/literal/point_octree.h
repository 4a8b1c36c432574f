#pragma once

// The octree of thesis 3.3, without optimizations: a node's octant is halved along each axis until one
// point is left, and a node has a pointer for each of its eight octants, empty or not.
//
// The root is the points' tightest box. Chains of single children are kept, because Figure 3.11 shows the
// depths of leaves. A division ends early where all points of a node are equal (any number of faces in one
// plane), or at `max_depth`. The octree does not depend on Hough space, so that it can contain the dual
// points of 3.2.1 for comparison.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

constexpr std::uint32_t k_no_node = 0xffffffffu;

/// Octant i lies on the high side of axis k when bit k of i is set.
struct OctreeNode {
    std::array<std::uint32_t, 8> children;  ///< k_no_node for an octant without a point.
    std::uint32_t begin, end;               ///< Its points in the octree's order.
    std::uint32_t depth;                    ///< 0 for the root.
    std::uint32_t child_count;              ///< 0 in a leaf.

    bool is_leaf() const noexcept { return child_count == 0; }
    std::uint32_t size() const noexcept { return end - begin; }
};

/// The region of space of a node, independent of its points: the thesis's OBV.
struct Octant {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};

    glm::dvec3 center() const noexcept { return 0.5 * low + 0.5 * high; }
    Octant child(std::uint32_t octant) const noexcept;
};

struct PointOctreeOptions {
    std::uint32_t bucket_size = 1;  ///< A node with no more points than this is a leaf. At least 1.
    std::uint32_t max_depth = 48;   ///< A node at this depth is a leaf. Doubles resolve 48 levels.
};

struct PointOctree {
    Octant root;                       ///< All zero without points.
    std::vector<OctreeNode> nodes;     ///< Parents before children; empty without points.
    std::vector<std::uint32_t> order;  ///< order[i] is the number of the point at position i.
};

/// Coordinates must be finite. O(points * depth), the same on every machine.
PointOctree build_point_octree(std::span<const glm::dvec3> points,
                               const PointOctreeOptions& options = {});

/// The numbers of leaves at depth 0, 1, 2, ... (Figure 3.11).
std::vector<std::uint32_t> leaf_depth_histogram(std::span<const OctreeNode> nodes);

}  // namespace rimline
