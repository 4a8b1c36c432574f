#pragma once

// The inner loops of the index, compiled for every instruction set that Highway knows for the target and
// selected at run time. Boxes are tested without fused multiply-add, so that all instruction sets visit the
// same blocks. The bits equal the face bit in any case.

#include <cstdint>
#include <span>
#include <string_view>

#include "silhouette/hough/block_set.h"

namespace rimline::kernels {

/// Fills `scratch` with the blocks of `tree` whose boxes do not decide all their planes (block_tree.h), and
/// their thresholds seen from `point`. Returns their number. Adds the number of tested nodes to `nodes`.
std::uint32_t find_mixed(const BlockTree& tree, const BlockPoint& point, BlockScratch& scratch,
                         std::uint64_t& nodes);

/// The same for the blocks with planes that two points may see from different sides; thresholds are seen from
/// `to`. The first `certain_count` of scratch.certain become the runs of blocks that certainly lie on
/// different sides: all their faces flip.
std::uint32_t find_changing(const BlockTree& tree, const BlockPoint& from, const BlockPoint& to,
                            BlockScratch& scratch, std::uint32_t& certain_count,
                            std::uint64_t& nodes);

struct TestedEdges {
    std::uint32_t found;     ///< Blocks.
    std::uint32_t doubtful;  ///< Of these, with doubts.
    std::uint32_t certain;   ///< Edges of found_lanes.
};
/// For the first `count` blocks of `scratch`: writes the blocks that hold edges on the silhouette, or edges
/// that must be decided exactly, to found_block. Their lanes are in found_lanes and found_doubts.
TestedEdges test_edges(const EdgeBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                       BlockScratch& scratch);

/// Writes the edges of the first `count` found blocks to `edges`, which must hold 16 more than there are.
/// Returns the end.
EdgeId* write_edges(std::span<const EdgeId> edges_of_blocks, std::uint32_t count,
                    const BlockScratch& scratch, EdgeId* edges);

struct TestedFaces {
    std::uint32_t found;     ///< Blocks.
    std::uint32_t doubtful;  ///< Of these, with doubts.
};
/// For the first `count` blocks of `scratch`: writes the blocks whose front bits differ from the low halves of
/// `states`, or must be decided exactly, to found_block. `states` has one word for each block. The lanes that
/// differ are in found_lanes; those to be decided are in found_doubts alone.
TestedFaces test_faces(const FaceBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                       std::span<const std::uint32_t> states, BlockScratch& scratch);

/// Sets the states of `blocks`: lanes that flip are inverted in the low half, and are the high half. Writes the
/// flipped faces in their order, to `faces` and, by position and with their new bit as the highest, to
/// `positions`. Both must hold 16 more than there are. Returns their number.
std::size_t flip_blocks(std::span<const FlippedBlock> blocks, std::span<const FaceId> face_at,
                        std::uint32_t* states, std::uint32_t* positions, FaceId* faces);

/// Writes the front bits of all blocks to `bits`, one word for each block. Lanes that must be decided exactly are 0;
/// they are in found_doubts of the found blocks, whose found_lanes are 0. Returns the number of these blocks.
std::uint32_t front_bits(const FaceBlocks& blocks, const BlockPoint& point,
                         std::span<std::uint16_t> bits, BlockScratch& scratch);

/// The selected instruction set, by Highway's name.
std::string_view instruction_set();

}  // namespace rimline::kernels
