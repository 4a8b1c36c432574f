#pragma once

// A tree over blocks in octree order (octree_order.h). Eight neighboring blocks make a node, and eight
// neighboring nodes make a node of the next level. There are no pointers: children of node i of a level are
// 8i to 8i + 7 of the level below. Below the last level are the blocks.
//
//     level 0   [ root                                  ]
//     level 1   [ 0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 ]
//     blocks    [ 0 .. 7 | 8 .. 15 | ...        | 56 .. ]
//
// A node holds the boxes of its children, c ± e, as structure of arrays: one sequence of instructions tests
// all eight. A box is not one of Hough points, in which a face's real value is a quadratic function, but one
// of planes N = (n, dO/D) (plane_block.h), in which it is linear. With s = S*Q, the values S*X of all planes
// in the box lie in [V - R, V + R]:
//
//     V = Σ c_i s_i          R = Σ e_i |s_i|
//
// So this is two sums of four products, where a box of Hough points against a v-sphere takes twice as many
// operations. It does not need the sign of dO, so edges that are SFO and planes that contain the origin are
// decided like all others. And V of a block is u times its threshold T. Where
//
//     |V| > R + spread
//
// the bits of all planes in the box are that of the sign of V:
//
//   spread             S*3.25*2^-24*|p| + 0.0305. The bit is certain where |S*X| > S*3.1*2^-24*|p|.
//   V in float         at most 0.0286, as T
//   R in float         never too small: extents are too large by 2^-20 of themselves, and five roundings and
//                      that of R + spread make it too small by at most 6 * 2^-24 of itself
//   N in double        dO errs by at most 2^-50 (|d| + |O|_1), and |d| <= 1.01 (D + |O|). S*w times that is
//                      at most 2^-48 (S*w*D + S*w|O|), S*w*D <= 32000, and w|O| <= |p| + |q|, S|q| <= 32000:
//                      below 2^-31 + S*2^-48*|p|
//
// Two points with s and t: a box is certainly on one side, or the other, of both, where this holds for either,
// with R = Σ e_i max(|s_i|, |t_i|) and the greater spread.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/plane_block.h"

namespace rimline {

constexpr std::uint32_t k_node_width = 8;

/// Lanes beyond the last child are NaN: all comparisons with them are false.
struct alignas(64) BlockNode {
    float center[4][k_node_width];
    float extent[4][k_node_width];
};

/// 1/u of the eight blocks below a node of the last level.
struct alignas(32) NodeSteps {
    float inverse[k_node_width];
};

class BlockTree {
public:
    BlockTree() = default;
    /// The blocks' boxes, none of them empty. Frames of blocks are BlockFrame(bounds). O(blocks) on all
    /// threads.
    explicit BlockTree(std::span<const BlockBounds> blocks);

    std::uint32_t block_count() const noexcept { return block_count_; }
    std::uint32_t level_count() const noexcept {
        return static_cast<std::uint32_t>(level_begin_.size()) - 1;
    }
    std::span<const BlockNode> level(std::uint32_t level) const noexcept {
        return std::span(nodes_).subspan(level_begin_[level],
                                         level_begin_[level + 1] - level_begin_[level]);
    }
    /// The nodes above the blocks, and the steps of these. Empty where there are no blocks.
    std::span<const BlockNode> last_level() const noexcept {
        return level_count() == 0 ? std::span<const BlockNode>() : level(level_count() - 1);
    }
    std::span<const NodeSteps> steps() const noexcept { return steps_; }
    std::uint32_t node_count() const noexcept { return static_cast<std::uint32_t>(nodes_.size()); }
    std::uint64_t size_bytes() const noexcept {
        return nodes_.size() * sizeof(BlockNode) + steps_.size() * sizeof(NodeSteps);
    }

private:
    std::vector<BlockNode> nodes_;
    std::vector<NodeSteps> steps_;
    std::vector<std::uint32_t> level_begin_{0};
    std::uint32_t block_count_ = 0;
};

}  // namespace rimline
