#pragma once

// The part of the index that belongs to one origin: blocks of sixteen faces for moves, blocks of sixteen
// edges for extraction, and a tree over each.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/hough/block_tree.h"
#include "silhouette/hough/plane_block.h"
#include "silhouette/mesh/ids.h"
#include "silhouette/mesh/plane.h"

namespace rimline {

/// The origin and the unit of length of the planes of one set of blocks.
struct BlockSpace {
    glm::dvec3 origin{};
    double length = 1.0;  ///< At least the maximum |dO|.

    BlockPoint seen_from(const HomogeneousPoint& point) const noexcept {
        return {point, origin, length};
    }
    /// All zero for a plane without a normal.
    PlaneVector vector_of(const Plane& plane) const noexcept {
        if (!plane.has_normal()) return {};
        const glm::dvec3 n = plane.normal();
        return {n.x, n.y, n.z, (double{plane.d} - glm::dot(n, origin)) / length};
    }
};

constexpr std::uint32_t block_count_of(std::size_t lanes) noexcept {
    return static_cast<std::uint32_t>((lanes + k_block_size - 1) / k_block_size);
}
/// The lanes in use of the last block.
constexpr std::uint32_t lanes_of_last_block(std::size_t lanes) noexcept {
    const std::size_t over = lanes % k_block_size;
    return over == 0 ? 0xffffu : (1u << over) - 1;
}

/// Blocks of faces. All lanes are in use, except in the last block.
struct FaceBlocks {
    BlockSpace space;
    BlockTree tree;
    std::vector<PlaneBlock> planes;
    std::uint32_t first_block = 0;  ///< The number of the first among the blocks of all origins.
    std::uint32_t last_lanes = 0;   ///< Of the last block, the lanes in use.

    /// Makes room for all blocks. Throws Error{cancelled}.
    void resize(std::size_t faces, const std::stop_token& stop);
    /// Writes the planes of a block, at most sixteen, and returns their box, for the tree. Blocks can be
    /// written at the same time.
    BlockBounds set(std::size_t block, std::span<const PlaneVector> of_block) noexcept;
};

/// The planes of both faces of an edge. The second is negated where both faces traverse the edge in the same
/// direction. So an edge is on the silhouette when the two bits differ.
using EdgePlanes = std::array<PlaneBlock, 2>;

struct EdgeBlocks {
    BlockSpace space;
    BlockTree tree;
    std::vector<EdgePlanes> planes;
    std::vector<EdgeId> edges;  ///< Sixteen for each block; k_no_edge after the last edge.
    std::uint32_t last_lanes = 0;

    /// Makes room for all blocks. All edges are k_no_edge. Throws Error{cancelled}.
    void resize(std::size_t edge_count, const std::stop_token& stop);
    /// The same for two planes of each edge, at most 32.
    BlockBounds set(std::size_t block, std::span<const PlaneVector> of_block) noexcept;
};

}  // namespace rimline
