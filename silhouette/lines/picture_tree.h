#pragma once

// A tree of boxes over the lines of a picture: which lines may lie before which.
//
// The lines are sorted by cells of the picture along a Z curve, so that those which follow each other lie near each
// other. 32 of them make a block, 32 blocks a block of the next level, and so on up to one. Blocks are compared with
// blocks first, and lines only with those of the blocks that are left.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
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
    /// `line` as their boxes say: they meet in the picture, and the other's nearest depth is not behind the line's
    /// farthest. In the order of the lines' cells along the curve, for one line in that of the others. O(lines log
    /// lines + pairs) if lines that follow each other lie near each other.
    template <typename Visit>
    void each_pair(Visit&& visit);

private:
    static constexpr std::uint32_t k_width = PictureBoxes::k_boxes;

    void sort();
    void find_groups(const PictureBox& box);
    std::span<const std::uint32_t> find_lines(const PictureBox& box);

    std::vector<PictureBox> boxes_, before_;
    std::vector<std::uint32_t> order_;  // The lines by their cells.
    std::vector<std::uint32_t> cells_, begin_;
    // From the lines up: of each block the boxes in it. The last level has one block.
    std::vector<std::vector<PictureBoxes>> levels_{1};
    std::vector<PictureBox> sums_, next_sums_;  // Of the blocks of one level.
    // Blocks of level 1 that may have a line before the lines of a block; blocks of level 0, and lines, before a
    // line. Each has room for all.
    std::vector<std::uint32_t> groups_, next_groups_, blocks_, lines_;
    std::size_t group_count_ = 0;
};

template <typename Visit>
void PictureTree::each_pair(Visit&& visit) {
    for (std::size_t first = 0; first < boxes_.size(); first += k_width) {
        const std::size_t last = std::min(first + k_width, boxes_.size());
        PictureBox all = k_empty_picture_box;
        for (std::size_t i = first; i < last; ++i) all.include(boxes_[order_[i]]);
        find_groups(all);
        for (std::size_t i = first; i < last; ++i)
            for (const std::uint32_t other : find_lines(boxes_[order_[i]]))
                visit(order_[i], order_[other]);
    }
}

}  // namespace rimline
