#pragma once

// The inner loop of the comparison of boxes (picture_tree.h), compiled for every instruction set that Highway knows
// for the target.

#include <cstddef>
#include <cstdint>
#include <span>

#include "silhouette/lines/picture_box.h"

namespace rimline::kernels {

/// The boxes of one level of a tree that may lie before a box: they meet it in the picture, and their nearest depth
/// is not behind its farthest. Tests only those blocks whose numbers `blocks` holds. Writes the numbers of the boxes to
/// `found`, in the order of the blocks, and returns how many there are. `found` has room for all boxes of these blocks.
std::size_t find_before(std::span<const PictureBoxes> level, std::span<const std::uint32_t> blocks,
                        const PictureBox& box, std::uint32_t* found) noexcept;

/// The same of the level below, in those blocks that it finds in `level`, and writes to `found_blocks`.
std::size_t find_below(std::span<const PictureBoxes> level, std::span<const std::uint32_t> blocks,
                       std::span<const PictureBoxes> below, const PictureBox& box,
                       std::uint32_t* found_blocks, std::uint32_t* found) noexcept;

}  // namespace rimline::kernels
