#pragma once

// The shape of an octree over points: an order in which every cell's points are contiguous, and the
// cells themselves in one array, without pointers.
//
// Points are sorted by their Morton codes (21 bits an axis) in their bounding cube; a cell of more than
// `bucket_size` points is split at the highest bits in which its codes differ, so a chain of single
// children never comes into being. Points that share a code though they differ are sorted again in a
// cube of their own: one stray point far away does not blunt the rest. Points that coincide, however
// many, share a leaf.
//
//     cells   [ root | children of root | children of cell 1 | children of cell 2 | ... ]
//
// O(n log n); the same on every machine.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

/// Points [begin, end) of the order; children [first_child, first_child + child_count) of the cells.
struct OctreeCell {
    std::uint32_t begin, end;
    std::uint32_t first_child;  ///< 0 in a leaf: the root is nobody's child.
    std::uint32_t child_count;  ///< 0 in a leaf, else 2 to 8.

    bool is_leaf() const noexcept { return child_count == 0; }
};

struct OctreeOrder {
    std::vector<std::uint32_t> order;  ///< order[i] is the number of the point at position i.
    std::vector<OctreeCell> cells;     ///< Parents before children; empty without points.
};

/// Cubes within cubes: each resolves 2^-21 of the one around it.
constexpr std::uint32_t k_octree_cube_depth = 21;
constexpr std::uint32_t k_octree_max_cubes = 3;
/// No leaf lies deeper, the root being at depth 0.
constexpr std::uint32_t k_octree_max_depth = k_octree_cube_depth * k_octree_max_cubes;
/// What a depth-first walk holds at most, when it pops a cell before it pushes its children.
constexpr std::uint32_t k_octree_max_stack = 7 * k_octree_max_depth + 1;

/// Coordinates must be finite, and their differences too. `bucket_size` must not be 0.
OctreeOrder octree_order(std::span<const glm::dvec3> points, std::uint32_t bucket_size);

}  // namespace rimline
