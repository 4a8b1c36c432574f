#pragma once

// A tree over blocks in octree order (octree_order.h). Eight neighboring blocks make a node, and eight
// neighboring nodes make a node of the next level. There are no pointers: children of node i of a level are
// 8i to 8i + 7 of the level below. Below the last level are the blocks.
//
//     level 0   [ root                                  ]
//     level 1   [ 0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 ]
//     blocks    [ 0 .. 7 | 8 .. 15 | ...        | 56 .. ]
//
// A node holds the boxes of its children. A box is not one of Hough points, in which a face's real value is a
// quadratic function, but one of planes N = (n, dO/D) (plane_block.h), in which it is linear. It does not need the
// sign of dO either: edges that are SFO, and planes that contain the origin, are decided like all others. Boxes are
// c ± e with c and e in steps of 2^-14, in 16 bits. With the weights W of a silhouette point,
//
//     V = Σ c_i W_i          R = Σ e_i |W_i|          are exact in 32 bits: four multiplications of pairs decide
//                                                     eight boxes
//     2^14 S*X = V + F,      |F| <= R + 22830         as |W_i - S*Q_i| <= 0.51, and |N|_1 <= sqrt(3) + 1
//
// The bit is certain where |S*X| > S*3.1*2^-24*|p|, which is below `spread`. So the bits of all planes in a box are
// that of the sign of V where
//
//     |V| - margin > R,      margin = 22900 + 2^14 spread
//
// N has an error in double: dO errs by at most 2^-50 (|d| + |O|_1), and |d| <= 1.01 (D + |O|). S*w times that is at
// most 2^-48 (S*w*D + S*w|O|). With S*w*D <= 32000, w|O| <= |p| + |q| and S|q| <= 32000 this is below
// 2^-31 + S*2^-48*|p|, for which `spread` has room. |V| is at most 2*2^14*32001 < 1.05e9, as |c|, |e| <= 2. The margin
// is clamped to 2^30, where nothing is certain.
//
// Two points: a box is certainly on one side, or the other, of either where this holds for both, with
// R = Σ e_i max(|W_i|, |W'_i|) < 1.49e9 and the greater margin.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/plane_block.h"

namespace rimline {

/// Centers and extents in steps of 2^-14. Pairs of components lie together, as in PlaneBlock.
struct alignas(64) BlockNode {
    std::array<std::int16_t, 2 * k_node_width> center_xy, center_zd, extent_xy, extent_zd;
};
static_assert(sizeof(BlockNode) == 128);

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
    /// The number of nodes of the next level, or of blocks.
    std::uint32_t child_count(std::uint32_t level) const noexcept {
        return level + 1 == level_count() ? block_count_
                                          : level_begin_[level + 2] - level_begin_[level + 1];
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
