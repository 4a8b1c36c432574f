#include "silhouette/lines/picture_tree.h"

#include <algorithm>
#include <bit>

#include "silhouette/lines/picture_kernels.h"

namespace rimline {

namespace {

constexpr int k_max_cell_bits = 10;  // Of each axis.

// Bit i to bit 2 * i.
std::uint32_t spread_bits(std::uint32_t value) {
    value = (value | value << 8) & 0x00ff00ffu;
    value = (value | value << 4) & 0x0f0f0f0fu;
    value = (value | value << 2) & 0x33333333u;
    return (value | value << 1) & 0x55555555u;
}

}  // namespace

void PictureTree::clear() {
    boxes_.clear();
    before_.clear();
}

void PictureTree::add(const PictureBox& box, const PictureBox& before) {
    boxes_.push_back(box);
    before_.push_back(before);
}

// By counting, with about a cell for each line.
void PictureTree::sort() {
    const std::size_t lines = boxes_.size();
    const int bits = std::clamp(static_cast<int>(std::bit_width(lines)) / 2, 1, k_max_cell_bits);
    const auto cell_of = [&](const PictureBox& box) {
        const auto middle = [&](std::int16_t low, std::int16_t high) {
            return static_cast<std::uint32_t>(low + high) >> (16 - bits);
        };
        return spread_bits(middle(box.low_x, box.high_x)) |
               spread_bits(middle(box.low_y, box.high_y)) << 1;
    };
    begin_.assign((std::size_t{1} << 2 * bits) + 1, 0);
    cells_.resize(lines);
    order_.resize(lines);
    for (std::size_t i = 0; i < lines; ++i) ++begin_[(cells_[i] = cell_of(boxes_[i])) + 1];
    for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell) begin_[cell + 1] += begin_[cell];
    for (std::uint32_t i = 0; i < lines; ++i) order_[begin_[cells_[i]]++] = i;
}

void PictureTree::finish() {
    sort();
    std::size_t count = 0;
    for (bool is_done = false; !is_done; ++count) {
        // Those of the lines, then those of the blocks below.
        const std::size_t boxes = count == 0 ? order_.size() : sums_.size();
        if (levels_.size() == count) levels_.emplace_back();
        std::vector<PictureBoxes>& level = levels_[count];
        const std::size_t blocks = std::max<std::size_t>((boxes + k_width - 1) / k_width, 1);
        level.resize(blocks);
        next_sums_.assign(blocks, k_empty_picture_box);
        for (std::size_t i = 0; i < blocks * k_width; ++i) {
            const PictureBox& box = i >= boxes   ? k_empty_picture_box
                                    : count == 0 ? before_[order_[i]]
                                                 : sums_[i];
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
    const std::span<const std::uint32_t> groups{groups_.data(), group_count_};
    const std::size_t count = levels_.size() > 1
                                  ? kernels::find_below(levels_[1], groups, levels_[0], box,
                                                        blocks_.data(), lines_.data())
                                  : kernels::find_before(levels_[0], groups, box, lines_.data());
    return {lines_.data(), count};
}

}  // namespace rimline
