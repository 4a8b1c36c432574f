#include "silhouette/lines/picture_tree.h"

#include <algorithm>

#include "silhouette/lines/picture_kernels.h"

namespace rimline {

void PictureTree::clear() {
    boxes_.clear();
    before_.clear();
}

void PictureTree::add(const PictureBox& box, const PictureBox& before) {
    boxes_.push_back(box);
    before_.push_back(before);
}

void PictureTree::finish() {
    std::size_t count = 0;
    for (bool is_done = false; !is_done; ++count) {
        // Those of the lines, then those of the blocks below.
        const std::vector<PictureBox>& below = count == 0 ? before_ : sums_;
        if (levels_.size() == count) levels_.emplace_back();
        std::vector<PictureBoxes>& level = levels_[count];
        const std::size_t blocks = std::max<std::size_t>((below.size() + k_width - 1) / k_width, 1);
        level.resize(blocks);
        next_sums_.assign(blocks, k_empty_picture_box);
        for (std::size_t i = 0; i < blocks * k_width; ++i) {
            const PictureBox& box = i < below.size() ? below[i] : k_empty_picture_box;
            level[i / k_width].set(i % k_width, box);
            next_sums_[i / k_width].include(box);
        }
        sums_.swap(next_sums_);
        is_done = blocks == 1;
    }
    levels_.resize(count);
    const auto room = [&](std::size_t level) {
        return level < levels_.size() ? levels_[level].size() * k_width : 1;
    };
    lines_.resize(room(0));
    blocks_.resize(room(1));
    groups_.resize(room(2));
    next_groups_.resize(room(2));
}

void PictureTree::find_groups(const PictureBox& box) {
    groups_[0] = 0;
    group_count_ = 1;
    for (std::size_t level = levels_.size() - 1; level > 1; --level) {
        group_count_ = kernels::find_before(levels_[level], {groups_.data(), group_count_}, box,
                                            next_groups_.data());
        groups_.swap(next_groups_);
    }
}

std::span<const std::uint32_t> PictureTree::find_lines(const PictureBox& box) {
    std::size_t block_count = 1;
    blocks_[0] = 0;
    if (levels_.size() > 1)
        block_count =
            kernels::find_before(levels_[1], {groups_.data(), group_count_}, box, blocks_.data());
    return {lines_.data(),
            kernels::find_before(levels_[0], {blocks_.data(), block_count}, box, lines_.data())};
}

}  // namespace rimline
