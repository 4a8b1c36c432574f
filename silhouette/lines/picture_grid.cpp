#include "silhouette/lines/picture_grid.h"

namespace rimline {

void PictureGrid::reset(const glm::dvec2& low, const glm::dvec2& high, double cell_width,
                        double margin) {
    const double width = std::max(high.x - low.x, 1e-300),
                 height = std::max(high.y - low.y, 1e-300);
    const double cell =
        std::max({cell_width, width / k_max_cells_a_side, height / k_max_cells_a_side, 1e-300});
    low_ = low;
    cells_a_unit_ = 1.0 / cell;
    slack_ = margin / cell + k_slack;
    columns_ = static_cast<int>(width / cell) + 1;
    rows_ = static_cast<int>(height / cell) + 1;
    added_.clear();
    begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
}

void PictureGrid::add(std::uint32_t segment, const glm::dvec2& from, const glm::dvec2& to) {
    each_cell(from, to, [&](std::uint32_t cell) {
        ++begin_[cell + 1];
        added_.push_back({cell, segment});
    });
}

void PictureGrid::finish() {
    for (std::size_t c = 0; c + 1 < begin_.size(); ++c) begin_[c + 1] += begin_[c];
    segments_.resize(begin_.back());
    next_.assign(begin_.begin(), begin_.end() - 1);
    for (const auto& [cell, segment] : added_) segments_[next_[cell]++] = segment;
}

}  // namespace rimline
