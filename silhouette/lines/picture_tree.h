#pragma once

// A tree of boxes over the lines of a picture: which lines may lie before which.
//
// Lines that are added one after another lie near each other, as those of a chain do. So eight of them make a block,
// eight blocks a block of the next level, and so on up to one. Blocks are compared with blocks first, and lines only
// with those of the blocks that are left.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "silhouette/lines/picture_box.h"

namespace rimline {

class PictureTree {
public:
    void clear();
    /// Lines are numbered from 0, in this order. One that lies before no other has the box `before` empty. Call
    /// finish() after the last.
    void add(const PictureBox& box, const PictureBox& before);
    void finish();

    /// Calls visit(line, other) for each pair of lines, also of a line with itself, where `other` may lie before
    /// `line` as their boxes say (may_lie_before()). By line, ascending, then by other. O(lines log lines + pairs) if
    /// lines that follow each other lie near each other.
    template <typename Visit>
    void each_pair(Visit&& visit);

private:
    static constexpr std::uint32_t k_width = 8;

    // Calls visit(k) for each bit.
    template <typename Visit>
    static void each_bit(std::uint32_t bits, Visit&& visit) {
        for (; bits != 0; bits &= bits - 1)
            visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
    void find_groups(const PictureBox& box);

    std::vector<PictureBox> boxes_, before_;
    // From the lines up: of each block the boxes in it. The last level has one block.
    std::vector<std::vector<EightPictureBoxes>> levels_{1};
    std::vector<PictureBox> sums_, next_sums_;  // Of the blocks of one level.
    std::vector<std::uint32_t> found_, next_;   // Blocks of one level.
};

template <typename Visit>
void PictureTree::each_pair(Visit&& visit) {
    const std::vector<EightPictureBoxes>& lines = levels_.front();
    for (std::size_t first = 0; first < boxes_.size(); first += k_width) {
        const std::size_t last = std::min(first + k_width, boxes_.size());
        PictureBox all = boxes_[first];
        for (std::size_t i = first + 1; i < last; ++i) all.include(boxes_[i]);
        find_groups(all);
        for (std::size_t i = first; i < last; ++i) {
            const PictureBox box = boxes_[i];
            const auto visit_block = [&](std::uint32_t block) {
                each_bit(may_lie_before(lines[block], box), [&](std::uint32_t k) {
                    visit(static_cast<std::uint32_t>(i), block * k_width + k);
                });
            };
            if (levels_.size() == 1) {
                visit_block(0);
                continue;
            }
            for (const std::uint32_t group : found_)
                each_bit(may_lie_before(levels_[1][group], box),
                         [&](std::uint32_t k) { visit_block(group * k_width + k); });
        }
    }
}

}  // namespace rimline
