#pragma once

// The working memory with which one thread searches an octree: HoughOctree::make_scratch() and
// UmbrellaIndex::make_scratch(). Kept from one call to the next, it saves allocations. Its content is private.

#include <array>
#include <cstdint>
#include <vector>

namespace rimline {

/// The number of faces or edges in one block of an octree.
constexpr std::uint32_t k_block_size = 16;
/// The number of blocks or nodes below a node of its tree.
constexpr std::uint32_t k_node_width = 8;

/// Blocks [first, last).
struct BlockRun {
    std::uint32_t first, last;
};

/// A block of faces some of which flip, as bits.
struct FlippedBlock {
    std::uint32_t block, lanes;
};

/// Blocks that no box decides, with the threshold and the margin of each (plane_block.h), and the results.
/// Arrays hold whole vectors beyond the last block.
struct BlockScratch {
    explicit BlockScratch(std::uint32_t max_blocks_of_a_set);
    std::uint64_t size_bytes() const noexcept;

    std::uint32_t max_blocks;

    std::array<std::vector<std::uint32_t>, 2> frontier;
    std::vector<std::uint32_t> block;
    std::vector<std::int32_t> threshold;
    std::vector<std::int32_t> margin;
    std::vector<std::uint32_t> found_block;
    std::vector<std::uint32_t> found_lanes;
    std::vector<std::uint32_t> found_doubts;
    std::vector<std::uint32_t> doubtful;  // Of the found blocks, those with doubts.
    std::vector<BlockRun> certain;
};

}  // namespace rimline
