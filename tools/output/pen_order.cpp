#include "tools/output/pen_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace rimline::tools {

namespace {

void turn_around(PageLine& line) {
    // Each curve leads to the point where it began.
    glm::dvec2 begin = line.points.front();
    for (CurvePiece& piece : line.curves) {
        std::swap(piece.control_1, piece.control_2);
        std::swap(piece.end, begin);
    }
    std::ranges::reverse(line.curves);
    std::ranges::reverse(line.points);
    std::ranges::reverse(line.chains);
    std::ranges::reverse(line.edges);
}

// The ends of lines that are not drawn yet, in square cells.
class LooseEnds {
public:
    struct End {
        std::uint32_t line;
        bool is_last;
        glm::dvec2 place;
    };

    explicit LooseEnds(std::span<const PageLine> lines) {
        glm::dvec2 high(-std::numeric_limits<double>::infinity());
        low_ = -high;
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            add_end({i, false, lines[i].points.front()});
            if (!lines[i].is_closed) add_end({i, true, lines[i].points.back()});
        }
        for (const End& end : ends_) {
            low_ = glm::min(low_, end.place);
            high = glm::max(high, end.place);
        }
        const glm::dvec2 size = high - low_;
        cell_ = std::max(std::sqrt(size.x * size.y / double(ends_.size())),
                         std::max({size.x, size.y, 1e-9}) / double(ends_.size()));
        columns_ = 1 + static_cast<int>(size.x / cell_);
        rows_ = 1 + static_cast<int>(size.y / cell_);
        cells_.resize(std::size_t(columns_) * std::size_t(rows_));
        for (std::uint32_t e = 0; e < ends_.size(); ++e) {
            const auto [column, row] = place_of(ends_[e].place);
            cells_[cell_at(column, row)].push_back(e);
        }
        is_drawn_.assign(lines.size(), false);
    }

    /// The nearest to a place, the first of equals; it and the other end of its line are drawn then. There must be one.
    End take_nearest(const glm::dvec2& place) {
        const auto [column, row] = place_of(place);
        std::uint32_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        // What lies in a ring of cells is at least this far away.
        for (int ring = 0; (ring - 1) * cell_ <= least && ring < columns_ + rows_; ++ring)
            each_of_ring(column, row, ring, [&](std::vector<std::uint32_t>& cell) {
                std::erase_if(cell, [&](std::uint32_t e) { return is_drawn_[ends_[e].line]; });
                for (const std::uint32_t e : cell) {
                    const double distance = glm::distance(ends_[e].place, place);
                    if (distance < least || (distance == least && e < best)) {
                        least = distance;
                        best = e;
                    }
                }
            });
        is_drawn_[ends_[best].line] = true;
        return ends_[best];
    }

private:
    void add_end(const End& end) { ends_.push_back(end); }
    std::pair<int, int> place_of(const glm::dvec2& place) const {
        const glm::dvec2 at = (place - low_) / cell_;
        return {static_cast<int>(std::clamp(at.x, 0.0, double(columns_ - 1))),
                static_cast<int>(std::clamp(at.y, 0.0, double(rows_ - 1)))};
    }
    std::size_t cell_at(int column, int row) const {
        return std::size_t(row) * std::size_t(columns_) + std::size_t(column);
    }
    template <typename Use>
    void each_of_ring(int column, int row, int ring, Use&& use) {
        for (int y = std::max(row - ring, 0); y <= std::min(row + ring, rows_ - 1); ++y) {
            const bool is_whole = y == row - ring || y == row + ring;
            const int step = is_whole || ring == 0 ? 1 : 2 * ring;
            for (int x = column - ring; x <= column + ring; x += step)
                if (x >= 0 && x < columns_) use(cells_[cell_at(x, y)]);
        }
    }

    std::vector<End> ends_;
    glm::dvec2 low_{};
    double cell_ = 1.0;
    int columns_ = 1, rows_ = 1;
    std::vector<std::vector<std::uint32_t>> cells_;  // Of ends_.
    std::vector<bool> is_drawn_;
};

}  // namespace

void order_for_pen(std::vector<PageLine>& lines) {
    const auto group = [](const PageLine& line) {
        return std::tuple(line.is_hidden, line.kind, line.ink);
    };
    std::ranges::stable_sort(lines, {}, group);
    std::vector<PageLine> ordered;
    ordered.reserve(lines.size());
    glm::dvec2 pen(0.0);
    for (std::size_t first = 0; first < lines.size();) {
        std::size_t last = first;
        while (last < lines.size() && group(lines[last]) == group(lines[first])) ++last;
        LooseEnds ends(std::span<const PageLine>(lines).subspan(first, last - first));
        for (std::size_t i = first; i < last; ++i) {
            const LooseEnds::End next = ends.take_nearest(pen);
            PageLine& line = ordered.emplace_back(std::move(lines[first + next.line]));
            if (next.is_last) turn_around(line);
            pen = line.is_closed ? line.points.front() : line.points.back();
        }
        first = last;
    }
    lines = std::move(ordered);
}

}  // namespace rimline::tools
