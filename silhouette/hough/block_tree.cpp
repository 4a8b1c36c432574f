#include "silhouette/hough/block_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "silhouette/error.h"
#include "silhouette/hough/rounded_float.h"

namespace rimline {

namespace {

BlockNode empty_node() {
    BlockNode node;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::uint32_t lane = 0; lane < k_node_width; ++lane)
            node.center[i][lane] = node.extent[i][lane] = std::numeric_limits<float>::quiet_NaN();
    return node;
}

void set_child(BlockNode& node, std::uint32_t lane, const BlockFrame& frame) {
    for (std::size_t i = 0; i < 4; ++i) {
        node.center[i][lane] = frame.center[i];
        node.extent[i][lane] = rounded_up(frame.extent[i] * (1.0 + 0x1p-20));
    }
}

}  // namespace

BlockTree::BlockTree(std::span<const BlockBounds> blocks)
    : block_count_(static_cast<std::uint32_t>(blocks.size())) {
    if (blocks.empty()) return;
    std::vector<std::vector<BlockNode>> levels;  // The lowest first.
    std::vector<BlockBounds> children;
    while (levels.empty() || levels.back().size() > 1) {
        const std::size_t size = (blocks.size() + k_node_width - 1) / k_node_width;
        std::vector<BlockNode>& level = levels.emplace_back(size);
        const bool is_last_level = levels.size() == 1;
        if (is_last_level) steps_.resize(size);
        std::vector<BlockBounds> parents(size);
        tbb::parallel_for(std::size_t{0}, size, [&](std::size_t i) {
            level[i] = empty_node();
            const std::size_t begin = i * k_node_width;
            const std::size_t end = std::min(blocks.size(), begin + k_node_width);
            for (std::size_t child = begin; child < end; ++child) {
                RIMLINE_CHECK(!blocks[child].is_empty());
                const BlockFrame frame(blocks[child]);
                set_child(level[i], static_cast<std::uint32_t>(child - begin), frame);
                if (is_last_level) steps_[i].inverse[child - begin] = frame.step_inverse;
                parents[i].include(blocks[child]);
            }
        });
        children = std::move(parents);
        blocks = children;
    }
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
        nodes_.insert(nodes_.end(), level->begin(), level->end());
        level_begin_.push_back(node_count());
    }
}

}  // namespace rimline
