#include "silhouette/hough/block_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "silhouette/error.h"

namespace rimline {

namespace {

// Of a double in steps of 2^-14. Beyond its own rounding, that of planes in double.
std::int16_t extent_steps(double extent) {
    return static_cast<std::int16_t>(std::ceil((extent + 0x1p-40) / k_center_step));
}

void set_child(BlockNode& node, std::uint32_t lane, const BlockFrame& frame) {
    for (std::size_t i = 0; i < 4; ++i)  // Else whole numbers could overflow.
        RIMLINE_CHECK(std::abs(double{frame.center[i]}) <= 1.0 && frame.extent[i] <= 1.001);
    const auto center = [&](std::size_t i) {
        return static_cast<std::int16_t>(double{frame.center[i]} / k_center_step);
    };
    for (std::size_t i = 0; i < 2; ++i) {
        node.center_xy[2 * lane + i] = center(i);
        node.center_zd[2 * lane + i] = center(2 + i);
        node.extent_xy[2 * lane + i] = extent_steps(frame.extent[i]);
        node.extent_zd[2 * lane + i] = extent_steps(frame.extent[2 + i]);
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
