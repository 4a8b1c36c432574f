#include "silhouette/lines/line_strokes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rimline {

namespace {

constexpr std::uint32_t k_no_mate = 0xffffffffu;
// Two ends go on into each other where their ways differ from straight on by less than 45 degrees.
constexpr double k_max_cos_of_ends = -0.7071067811865476;
// Where two ends touch and no third, the pen goes on around a corner of up to 100 degrees.
constexpr double k_max_cos_of_corner = 0.17364817766693033;
constexpr double k_touch = 1e-3;  // Of the gap.
// Not back over itself: the gap leads forwards, by at least this cosine.
constexpr double k_min_cos_of_gap = -0.3;

bool is_loop(const LineDrawing& drawing, const LineRun& run) {
    const LineChain& chain = drawing.chains[run.chain];
    return chain.is_closed && chain.last_run - chain.first_run == 1;
}

}  // namespace

void LineStrokes::find_ends(double gap, const LineDrawing& drawing) {
    ends_.clear();
    for (std::uint32_t r = 0; r < drawing.runs.size(); ++r) {
        const LineRun& run = drawing.runs[r];
        if (!run.is_visible() || is_loop(drawing, run)) continue;
        const std::span<const LinePoint> points = drawing.points_of(run);
        for (std::uint32_t k = 0; k < 2; ++k) {
            const auto at = [&](std::size_t i) {
                return points[k == 0 ? i : points.size() - 1 - i].position;
            };
            // The way over as much of the run as the gap is long, so that a bent last edge does not decide.
            std::size_t i = 1;
            while (i + 1 < points.size() && glm::length(at(i) - at(0)) < gap) ++i;
            const glm::dvec2 way = at(0) - at(i);
            const double length = glm::length(way);
            if (length > 0.0) ends_.push_back({2 * r + k, at(0), way / length});
        }
    }
    std::sort(ends_.begin(), ends_.end(), [](const RunEnd& a, const RunEnd& b) {
        return a.position.x != b.position.x ? a.position.x < b.position.x : a.end < b.end;
    });
}

bool LineStrokes::is_corner(std::size_t i, std::size_t j, double gap) const {
    const double touch = k_touch * gap;
    const auto is_third = [&](std::size_t k) {
        return k != i && k != j &&
               glm::length(ends_[k].position - ends_[i].position) <= 2.0 * touch;
    };
    const double x = ends_[i].position.x;
    for (std::size_t k = i; k > 0 && x - ends_[k - 1].position.x <= 2.0 * touch; --k)
        if (is_third(k - 1)) return false;
    for (std::size_t k = i + 1; k < ends_.size() && ends_[k].position.x - x <= 2.0 * touch; ++k)
        if (is_third(k)) return false;
    return true;
}

void LineStrokes::find_pairs(double gap, const LineDrawing& drawing) {
    pairs_.clear();
    for (std::size_t i = 0; i < ends_.size(); ++i)
        for (std::size_t j = i + 1;
             j < ends_.size() && ends_[j].position.x - ends_[i].position.x <= gap; ++j) {
            const RunEnd &a = ends_[i], &b = ends_[j];
            const glm::dvec2 way = b.position - a.position;
            const double distance = glm::length(way);
            // Ends of one run close a loop only if the run is much longer than the gap.
            if (distance > gap ||
                (a.end / 2 == b.end / 2 && drawing.runs[a.end / 2].length < 4.0 * gap))
                continue;
            const double cos = glm::dot(a.way, b.way);
            if (cos > k_max_cos_of_ends &&
                !(cos <= k_max_cos_of_corner && distance <= k_touch * gap && is_corner(i, j, gap)))
                continue;
            if (distance > 0.1 * gap && glm::dot(a.way, way) < k_min_cos_of_gap * distance)
                continue;
            const double share = gap > 0.0 ? distance / gap : 0.0;
            pairs_.push_back({share + 1.0 + cos, a.end, b.end});
        }
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
        if (a.score != b.score) return a.score < b.score;
        return a.a != b.a ? a.a < b.a : a.b < b.b;
    });
}

void LineStrokes::follow(std::uint32_t first_end, bool is_closed, double min_length,
                         LineDrawing& drawing) {
    LineStroke stroke{.first_part = static_cast<std::uint32_t>(drawing.stroke_parts.size()),
                      .last_part = 0,
                      .is_closed = is_closed,
                      .length = 0.0};
    for (std::uint32_t end = first_end;;) {
        const std::uint32_t run = end / 2;
        is_done_[run] = 1;
        drawing.stroke_parts.push_back({run, end % 2 != 0});
        stroke.length += drawing.runs[run].length;
        const std::uint32_t next = mates_[end ^ 1u];
        if (next == k_no_mate || is_done_[next / 2] != 0) break;
        end = next;
    }
    stroke.last_part = static_cast<std::uint32_t>(drawing.stroke_parts.size());
    if (stroke.length < min_length)
        drawing.stroke_parts.resize(stroke.first_part);
    else
        drawing.strokes.push_back(stroke);
}

void LineStrokes::join(const LineOptions& options, LineDrawing& drawing) {
    mates_.assign(2 * drawing.runs.size(), k_no_mate);
    is_done_.assign(drawing.runs.size(), 0);
    find_ends(options.gap, drawing);
    find_pairs(options.gap, drawing);
    for (const Pair& pair : pairs_) {
        if (mates_[pair.a] != k_no_mate || mates_[pair.b] != k_no_mate) continue;
        mates_[pair.a] = pair.b;
        mates_[pair.b] = pair.a;
    }
    for (const bool closed : {false, true})
        for (std::uint32_t r = 0; r < drawing.runs.size(); ++r) {
            if (is_done_[r] != 0 || !drawing.runs[r].is_visible()) continue;
            if (is_loop(drawing, drawing.runs[r])) {
                follow(2 * r, true, options.min_length, drawing);
                continue;
            }
            for (std::uint32_t k = 0; k < 2 && is_done_[r] == 0; ++k)
                if (closed || mates_[2 * r + k] == k_no_mate)
                    follow(2 * r + k, closed, options.min_length, drawing);
        }
}

}  // namespace rimline
