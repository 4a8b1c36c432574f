#pragma once

// The loops that the index spends its time in, compiled for every instruction set that Highway knows for
// the target and chosen when the program runs. Boxes are tested without fused multiplication, so that
// all of them look at the same blocks; bits are the face bit's either way.

#include <cstdint>
#include <span>
#include <string_view>

#include "silhouette/hough/block_set.h"

namespace rimline::kernels {

/// What settles a block: its box against the query, or also its threshold (plane_block.h), which says
/// something of the one point alone.
enum class SettledBy { box, box_and_threshold };

/// Fills `scratch` with the blocks of `tree` that `query` does not settle, and their thresholds seen
/// from `point`. Returns their number; adds to `nodes` how many nodes were tested.
std::uint32_t find_mixed(const BoxTree& tree, std::span<const NodeFrames> frames,
                         const BoxQuery& query, const BlockPoint& point, SettledBy settled_by,
                         BlockScratch& scratch, std::uint64_t& nodes);

/// The same for what may lie on different sides of two v-spheres. The first `certain_count` of
/// scratch.certain become the runs of blocks that certainly do, whose faces all flip.
std::uint32_t find_changing(const BoxTree& tree, std::span<const NodeFrames> frames,
                            const BoxQuery& from, const BoxQuery& to, const BlockPoint& point,
                            BlockScratch& scratch, std::uint32_t& certain_count,
                            std::uint64_t& nodes);

/// Fills `scratch` with all blocks.
std::uint32_t take_all(std::span<const NodeFrames> frames, std::uint32_t block_count,
                       const BlockPoint& point, BlockScratch& scratch);
/// Fills `scratch` with the blocks that their thresholds do not settle. Returns their number.
std::uint32_t find_near(std::span<const NodeFrames> frames, std::uint32_t block_count,
                        const BlockPoint& point, BlockScratch& scratch);

/// For the first `count` blocks of `scratch`: found_block and found_lanes become those that hold edges
/// on the silhouette, or in found_doubts, whose lanes must be decided exactly. Returns their number.
std::uint32_t test_edges(const EdgeBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                         BlockScratch& scratch);

/// Writes the edges of the first `count` found blocks to `edges`, which has room for 16 more than there
/// are, and returns the end.
EdgeId* write_edges(std::span<const EdgeId> edges_of_blocks, std::uint32_t count,
                    const BlockScratch& scratch, EdgeId* edges);

/// For the first `count` blocks of `scratch`: found_block and found_lanes become those whose front bits
/// are not `bits`, which has one word for each block, or in found_doubts, whose lanes must be decided
/// exactly; lanes in doubt are not among found_lanes. Returns their number.
std::uint32_t test_faces(const FaceBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                         std::span<const std::uint16_t> bits, BlockScratch& scratch);

/// What is in use, as Highway names it.
std::string_view instruction_set();

}  // namespace rimline::kernels
