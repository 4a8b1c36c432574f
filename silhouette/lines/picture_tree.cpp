#include "silhouette/lines/picture_tree.h"

#include <algorithm>

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
        std::vector<EightPictureBoxes>& level = levels_[count];
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
}

// Sets found_ to the blocks of level 1 that may have a line before the box.
void PictureTree::find_groups(const PictureBox& box) {
    found_.assign(1, 0);
    for (std::size_t level = levels_.size() - 1; level > 1; --level) {
        next_.clear();
        for (const std::uint32_t block : found_)
            each_bit(may_lie_before(levels_[level][block], box),
                     [&](std::uint32_t k) { next_.push_back(block * k_width + k); });
        found_.swap(next_);
    }
}

}  // namespace rimline
