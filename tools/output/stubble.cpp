#include "tools/output/stubble.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "silhouette/lines/picture_grid.h"

namespace rimline::tools {

namespace {

// Doubles are shorter than this many minimal lengths.
constexpr double k_double_lengths = 6.0;

struct LineSpan {
    std::uint32_t line;
    glm::dvec2 from, to;
    bool begins_line, ends_line;  // At an end of the line, which is open.
};

class Stubble {
public:
    Stubble(const PictureLines& lines, const StubbleLimits& limits)
        : lines_(lines), limits_(limits) {
        glm::dvec2 low(0.0), high(0.0);
        for (const glm::dvec2& point : lines.points)
            low = glm::min(low, point), high = glm::max(high, point);
        grid_.reset(low, high, 4.0 * std::max(limits.reach, limits.double_reach));
        for (std::uint32_t i = 0; i < lines.lines.size(); ++i) {
            lengths_.push_back(0.0);
            each_span(i, [&](const glm::dvec2& from, const glm::dvec2& to) {
                grid_.add(static_cast<std::uint32_t>(spans_.size()), from, to);
                spans_.push_back({i, from, to, false, false});
                lengths_.back() += glm::distance(from, to);
            });
            if (lines.lines[i].is_closed ||
                lines.lines[i].last_point - lines.lines[i].first_point < 2)
                continue;
            spans_[spans_.size() - (lines.lines[i].last_point - lines.lines[i].first_point - 1)]
                .begins_line = true;
            spans_.back().ends_line = true;
        }
        grid_.finish();
    }

    bool is_stubble(std::uint32_t i) const {
        const PictureLine& line = lines_.lines[i];
        if (lengths_[i] < 2.0 * limits_.min_length) {
            const auto is_held = [&](std::uint32_t end) {
                return is_beside(lines_.points[end], i, limits_.reach, false);
            };
            const int loose_ends = line.is_closed ? 1
                                                  : int(!is_held(line.first_point)) +
                                                        int(!is_held(line.last_point - 1));
            if (lengths_[i] < loose_ends * limits_.min_length) return true;
        }
        if (lengths_[i] >= k_double_lengths * limits_.min_length) return false;
        // At places no farther from each other than the lines are.
        bool is_double = true;
        each_span(i, [&](const glm::dvec2& from, const glm::dvec2& to) {
            const int parts = 1 + static_cast<int>(glm::distance(from, to) / limits_.double_reach);
            for (int part = 0; part <= parts && is_double; ++part)
                is_double = is_beside(glm::mix(from, to, double(part) / parts), i,
                                      limits_.double_reach, true);
        });
        return is_double;
    }

private:
    template <typename Visit>
    void each_span(std::uint32_t i, Visit&& visit) const {
        const PictureLine& line = lines_.lines[i];
        for (std::uint32_t point = line.first_point; point + 1 < line.last_point; ++point)
            visit(lines_.points[point], lines_.points[point + 1]);
        if (line.is_closed)
            visit(lines_.points[line.last_point - 1], lines_.points[line.first_point]);
    }

    // Whether another line that can hold line `i` passes within `reach` of a place.
    bool is_beside(const glm::dvec2& place, std::uint32_t i, double reach,
                   bool must_be_longer) const {
        const auto holds = [&](const LineSpan& span) {
            if (span.line == i || (lines_.lines[span.line].is_hidden && !lines_.lines[i].is_hidden))
                return false;
            const bool is_longer = lengths_[span.line] > lengths_[i] ||
                                   (lengths_[span.line] == lengths_[i] && span.line < i);
            if (must_be_longer && !is_longer) return false;
            const glm::dvec2 way = span.to - span.from;
            const double square = std::max(glm::dot(way, way), 1e-300);
            const double on_line = glm::dot(place - span.from, way) / square;
            // Before the end of a line lies no double of it, but what goes on from there.
            if (must_be_longer &&
                ((span.begins_line && on_line < 0.0) || (span.ends_line && on_line > 1.0)))
                return false;
            const double share = std::clamp(on_line, 0.0, 1.0);
            return glm::distance(place, span.from + share * way) <= reach;
        };
        // Cells are wider than what is in reach, so these are all.
        bool is_held = false;
        for (const glm::dvec2& corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
            const glm::dvec2 at = place + reach * corner;
            grid_.each_cell(at, at, [&](std::uint32_t cell) {
                for (const std::uint32_t span : grid_.segments_in(cell))
                    is_held = is_held || holds(spans_[span]);
            });
            if (is_held) return true;
        }
        return false;
    }

    const PictureLines& lines_;
    StubbleLimits limits_;
    PictureGrid grid_;
    std::vector<LineSpan> spans_;
    std::vector<double> lengths_;  // Of each line.
};

}  // namespace

void remove_stubble(PictureLines& lines, const StubbleLimits& limits) {
    for (;;) {
        const Stubble stubble(lines, limits);
        std::vector<PictureLine> kept;
        for (std::uint32_t i = 0; i < lines.lines.size(); ++i)
            if (!stubble.is_stubble(i)) kept.push_back(lines.lines[i]);
        if (kept.size() == lines.lines.size()) return;
        lines.lines = std::move(kept);
    }
}

}  // namespace rimline::tools
