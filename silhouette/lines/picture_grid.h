#pragma once

// A uniform grid of cells over a picture, and the segments that pass through each cell.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace rimline {

class PictureGrid {
public:
    /// Empty, over the box, with cells of about this width. There are at most k_max_cells_a_side along a side.
    void reset(const glm::dvec2& low, const glm::dvec2& high, double cell_width,
               double margin = 0.0);

    /// Calls visit(cell) for each cell that the segment may pass through, or that is nearer to it than the margin
    /// along an axis. Coordinates outside of the box count as on its border.
    template <typename Visit>
    void each_cell(const glm::dvec2& from, const glm::dvec2& to, Visit&& visit) const;

    /// Notes that a segment passes through its cells. Call finish() after the last.
    void add(std::uint32_t segment, const glm::dvec2& from, const glm::dvec2& to);
    void finish();
    /// The segments of a cell, ascending if they were added so. Valid until the next reset().
    std::span<const std::uint32_t> segments_in(std::uint32_t cell) const noexcept {
        return {segments_.data() + begin_[cell], segments_.data() + begin_[cell + 1]};
    }

private:
    static constexpr double k_max_cells_a_side = 2000.0;
    static constexpr double k_slack = 1e-7;  // Of a cell. Rounding errors are much smaller.

    glm::dvec2 low_{0.0};
    double cells_a_unit_ = 1.0;
    double slack_ = k_slack;  // The margin in cells.
    int columns_ = 1, rows_ = 1;
    std::vector<std::array<std::uint32_t, 2>> added_;  // Cell and segment.
    std::vector<std::uint32_t> begin_, segments_, next_;
};

template <typename Visit>
void PictureGrid::each_cell(const glm::dvec2& from, const glm::dvec2& to, Visit&& visit) const {
    const glm::dvec2 last(columns_, rows_);
    const auto in_cells = [&](const glm::dvec2& p) {
        const glm::dvec2 q = (p - low_) * cells_a_unit_;
        return glm::dvec2(std::clamp(q.x, 0.0, last.x), std::clamp(q.y, 0.0, last.y));
    };
    glm::dvec2 a = in_cells(from), b = in_cells(to);
    if (a.y > b.y) std::swap(a, b);
    const auto clamped = [](double c, int count) {
        return std::clamp(static_cast<int>(c), 0, count - 1);
    };
    const int first_row = clamped(a.y - slack_, rows_), last_row = clamped(b.y + slack_, rows_);
    const double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0.0;
    const double left = std::min(a.x, b.x), right = std::max(a.x, b.x);
    for (int row = first_row; row <= last_row; ++row) {
        // Where the line enters and leaves the row, by no more than the slack beyond its ends.
        const double p =
            row == first_row ? a.x : std::clamp(a.x + slope * (row - a.y - slack_), left, right);
        const double q =
            row == last_row ? b.x : std::clamp(a.x + slope * (row + 1 - a.y + slack_), left, right);
        const int first = clamped(std::min(p, q) - slack_, columns_);
        const int end = clamped(std::max(p, q) + slack_, columns_);
        for (int column = first; column <= end; ++column)
            visit(static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns_) +
                  static_cast<std::uint32_t>(column));
    }
}

}  // namespace rimline
