#pragma once

// The octree of thesis 3.3, as plain as it stands there: a node's octant is halved along each axis until
// one point is left, and a node has a pointer for each of its eight octants, empty or not.
//
// The root is the points' tightest box. Chains of single children are kept, for the depths of leaves
// are what Figure 3.11 shows. Two things end a division early: all points of a node are one and the
// same (faces in one plane, however many), or `max_depth` is reached. It knows nothing of Hough space,
// so that the dual points of 3.2.1 can be put into one for comparison.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

constexpr std::uint32_t k_no_node = 0xffffffffu;

/// Octant i lies on the high side of axis k when bit k of i is set.
struct OctreeNode {
    std::array<std::uint32_t, 8> children;  ///< k_no_node where an octant holds no point.
    std::uint32_t begin, end;               ///< Its points in the octree's order.
    std::uint32_t depth;                    ///< 0 for the root.
    std::uint32_t child_count;              ///< 0 in a leaf.

    bool is_leaf() const noexcept { return child_count == 0; }
    std::uint32_t size() const noexcept { return end - begin; }
};

/// The region of space that is a node's, whatever it holds there: the thesis's OBV.
struct Octant {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};

    glm::dvec3 center() const noexcept { return 0.5 * low + 0.5 * high; }
    Octant child(std::uint32_t octant) const noexcept;
};

struct PointOctreeOptions {
    std::uint32_t bucket_size = 1;  ///< A node with no more points than this is a leaf. Not 0.
    std::uint32_t max_depth = 48;   ///< So is every node at this depth; doubles resolve it.
};

struct PointOctree {
    Octant root;                       ///< All zero without points.
    std::vector<OctreeNode> nodes;     ///< Parents before children; empty without points.
    std::vector<std::uint32_t> order;  ///< order[i] is the number of the point at position i.
};

/// Coordinates must be finite. O(points * depth), the same on every machine.
PointOctree build_point_octree(std::span<const glm::dvec3> points,
                               const PointOctreeOptions& options = {});

/// How many leaves lie at depth 0, 1, 2, ...: Figure 3.11.
std::vector<std::uint32_t> leaf_depth_histogram(std::span<const OctreeNode> nodes);

}  // namespace rimline
