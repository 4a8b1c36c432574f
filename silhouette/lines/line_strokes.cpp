#include "silhouette/lines/line_strokes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "silhouette/error.h"
#include "silhouette/lines/cut_part.h"

namespace rimline {

namespace {

// Two ends go on into each other where their ways differ from straight on by less than 45 degrees.
constexpr double k_max_cos_of_ends = -0.7071067811865476;
// Where two ends touch and no third, the pen goes on around a corner of up to 100 degrees.
constexpr double k_max_cos_of_corner = 0.17364817766693033;
constexpr double k_touch = 1e-3;  // Of the gap.
// Not back over itself: the gap leads forwards, by at least this cosine.
constexpr double k_min_cos_of_gap = -0.3;
// Runs overlap by at most this. Where they do, each lies no farther from the other than that, and one of them ends no
// farther than half of it. Of the gap.
constexpr double k_max_overlap = 6.0, k_max_aside = 1.0;
constexpr std::size_t k_ends_a_checkpoint = 1u << 12;

// A chain that is closed but for what is covered by another is none.
bool is_loop(const LineDrawing& drawing, const LineRun& run) {
    const LineChain& chain = drawing.chains[run.chain];
    const std::span<const LinePoint> points = drawing.points_of(run);
    return chain.is_closed && chain.last_run - chain.first_run == 1 &&
           glm::distance(points.front().position, points.back().position) <= 1e-9 * chain.length;
}

// Places of a run are numbers of points with a share.
glm::dvec2 place_at(std::span<const LinePoint> points, double at) {
    const std::size_t i = std::min(static_cast<std::size_t>(at), points.size() - 2);
    return glm::mix(points[i].position, points[i + 1].position, at - double(i));
}

double arc_at(std::span<const LinePoint> points, double at) {
    const std::size_t i = std::min(static_cast<std::size_t>(at), points.size() - 2);
    return glm::mix(points[i].arc, points[i + 1].arc, at - double(i));
}

// The way out of a run that ends at `at`, over as much of it as the gap is long, so that a bent last edge does not
// decide. Of length 1, or 0 where it has none.
glm::dvec2 way_out(std::span<const LinePoint> points, double at, bool is_last, double gap) {
    const glm::dvec2 end = place_at(points, at);
    std::size_t i = is_last ? static_cast<std::size_t>(std::max(std::ceil(at) - 1.0, 0.0))
                            : std::min(static_cast<std::size_t>(at) + 1, points.size() - 1);
    const std::size_t stop = is_last ? 0 : points.size() - 1;
    while (i != stop && glm::distance(points[i].position, end) < gap) i += is_last ? -1 : 1;
    const glm::dvec2 way = end - points[i].position;
    const double length = glm::length(way);
    return length > 0.0 ? way / length : glm::dvec2(0.0);
}

}  // namespace

void LineStrokes::find_ends(double gap, const LineDrawing& drawing) {
    ends_.clear();
    for (std::uint32_t r = 0; r < drawing.runs.size(); ++r) {
        const LineRun& run = drawing.runs[r];
        if (!run.is_visible() || is_loop(drawing, run)) continue;
        const std::span<const LinePoint> points = drawing.points_of(run);
        for (const bool is_last : {false, true}) {
            const double at = is_last ? double(points.size() - 1) : 0.0;
            const glm::dvec2 way = way_out(points, at, is_last, gap);
            if (way != glm::dvec2(0.0))
                ends_.push_back({2 * r + (is_last ? 1 : 0), place_at(points, at), way});
        }
    }
    std::sort(ends_.begin(), ends_.end(), [](const RunEnd& a, const RunEnd& b) {
        return a.position.x != b.position.x ? a.position.x < b.position.x : a.end < b.end;
    });
}

// Rows, and not x alone, because many ends may lie on one line along y: those of the slats of a blind.
void LineStrokes::find_rows(double height) {
    double farthest = 0.0;
    for (const RunEnd& end : ends_) farthest = std::max(farthest, std::abs(end.position.y));
    // So much higher that ends of this distance never lie more than a row apart, whatever is rounded.
    const double row_height = std::max(1.01 * height, farthest * 0x1p-40);
    row_numbers_.clear();
    for (const RunEnd& end : ends_)
        row_numbers_.push_back(row_height > 0.0 ? std::floor(end.position.y / row_height) : 0.0);
    row_ends_.resize(ends_.size());
    std::iota(row_ends_.begin(), row_ends_.end(), std::size_t{0});
    std::sort(row_ends_.begin(), row_ends_.end(), [&](std::size_t a, std::size_t b) {
        return row_numbers_[a] != row_numbers_[b] ? row_numbers_[a] < row_numbers_[b] : a < b;
    });
    rows_.clear();
    row_of_.resize(ends_.size());
    for (std::size_t k = 0; k < row_ends_.size(); ++k) {
        const double number = row_numbers_[row_ends_[k]];
        if (rows_.empty() || rows_.back().number != number) rows_.push_back({number, k, k});
        rows_.back().last = k + 1;
        row_of_[row_ends_[k]] = rows_.size() - 1;
    }
}

template <typename Visit>
bool LineStrokes::any_beside(std::size_t i, double reach, Visit&& visit) const {
    const double x = ends_[i].position.x, number = rows_[row_of_[i]].number;
    const std::size_t own = row_of_[i];
    for (std::size_t r = own > 0 ? own - 1 : 0; r < std::min(own + 2, rows_.size()); ++r) {
        if (std::abs(rows_[r].number - number) > 1.0) continue;
        const std::span<const std::size_t> row =
            std::span(row_ends_).subspan(rows_[r].first, rows_[r].last - rows_[r].first);
        const auto here = std::ranges::lower_bound(row, i);
        for (auto k = here; k != row.begin() && x - ends_[k[-1]].position.x <= reach; --k)
            if (visit(k[-1])) return true;
        for (auto k = here; k != row.end() && ends_[*k].position.x - x <= reach; ++k)
            if (*k != i && visit(*k)) return true;
    }
    return false;
}

bool LineStrokes::is_corner(std::size_t i, std::size_t j, double gap) const {
    const double touch = k_touch * gap;
    return !any_beside(i, 2.0 * touch, [&](std::size_t k) {
        return k != j && glm::length(ends_[k].position - ends_[i].position) <= 2.0 * touch;
    });
}

// The place of the run nearest to this one, on the last stretch of this length before the end.
LineStrokes::NearestPlace LineStrokes::nearest_before(const RunEnd& end, const glm::dvec2& place,
                                                      double reach, const LineDrawing& drawing) {
    const std::span<const LinePoint> points = drawing.points_of(drawing.runs[end.end / 2]);
    const std::size_t last = points.size() - 1;
    const auto number = [&](std::size_t i) { return end.end % 2 == 0 ? i : last - i; };
    NearestPlace nearest{0.0, std::numeric_limits<double>::infinity()};
    double length = 0.0;
    for (std::size_t i = 0; i < last && length < reach; ++i) {
        const glm::dvec2 from = points[number(i)].position;
        const glm::dvec2 way = points[number(i + 1)].position - from;
        const double square = glm::dot(way, way);
        if (square == 0.0) continue;
        const double share = std::clamp(glm::dot(place - from, way) / square, 0.0, 1.0);
        const double distance = glm::distance(place, from + share * way);
        if (distance < nearest.distance)
            nearest = {end.end % 2 == 0 ? double(i) + share : double(last - i) - share, distance};
        length += std::sqrt(square);
    }
    return nearest;
}

void LineStrokes::add_pair(std::size_t i, std::size_t j, double gap, const LineDrawing& drawing) {
    const RunEnd &a = ends_[i], &b = ends_[j];
    const glm::dvec2 way = b.position - a.position;
    const double distance = glm::length(way);
    const bool is_loop = a.end / 2 == b.end / 2;
    const double run_length = drawing.runs[a.end / 2].length;
    const double cos = glm::dot(a.way, b.way);
    const double share = gap > 0.0 ? distance / gap : 0.0;
    const bool goes_on = cos <= k_max_cos_of_ends;
    const bool leads_forwards =
        distance <= 0.1 * gap ||
        std::min(glm::dot(a.way, way), -glm::dot(b.way, way)) >= k_min_cos_of_gap * distance;
    // Ends of one run close a loop only if the run is much longer than the gap.
    if (distance <= gap && leads_forwards && !(is_loop && run_length < 4.0 * gap) &&
        (goes_on ||
         (cos <= k_max_cos_of_corner && distance <= k_touch * gap && is_corner(i, j, gap)))) {
        pairs_.push_back({share + 1.0 + cos, a.end, b.end, {}});
        return;
    }
    const double reach = k_max_overlap * gap;
    if (goes_on && distance <= reach && !(is_loop && run_length < 4.0 * reach) &&
        glm::dot(a.way, way) < 0.0 && glm::dot(b.way, way) > 0.0)
        add_overlap(a, b, gap, drawing);
}

// Two runs that each end beside the other. One of them is cut where the other one ends.
void LineStrokes::add_overlap(const RunEnd& a, const RunEnd& b, double gap,
                              const LineDrawing& drawing) {
    const double reach = k_max_overlap * gap, aside = k_max_aside * gap;
    const NearestPlace on_a = nearest_before(a, b.position, reach, drawing);
    const NearestPlace on_b = nearest_before(b, a.position, reach, drawing);
    // What is cut off lies beside the other run.
    const auto is_beside = [&](const RunEnd& end, double at, const RunEnd& other) {
        const std::span<const LinePoint> points = drawing.points_of(drawing.runs[end.end / 2]);
        const bool is_last = end.end % 2 != 0;
        const std::size_t begin = is_last ? static_cast<std::size_t>(at) + 1 : 0;
        for (std::size_t i = begin; i < points.size() && (is_last || double(i) < at); ++i)
            if (nearest_before(other, points[i].position, reach, drawing).distance > aside)
                return false;
        return true;
    };
    if (!is_beside(a, on_a.at, b) || !is_beside(b, on_b.at, a)) return;
    const auto cut_at = [&](const NearestPlace& place, const RunEnd& end, const RunEnd& other) {
        const std::span<const LinePoint> points = drawing.points_of(drawing.runs[end.end / 2]);
        const glm::dvec2 way = way_out(points, place.at, end.end % 2 != 0, gap);
        const double cos = glm::dot(way, other.way);
        if (place.distance > 0.5 * aside || cos > k_max_cos_of_ends) return Cut{};
        return Cut{end.end, place.at, place.distance / gap + 1.0 + cos};
    };
    std::array<Cut, 2> cuts{cut_at(on_a, a, b), cut_at(on_b, b, a)};
    if (cuts[1].score <= cuts[0].score) std::swap(cuts[0], cuts[1]);
    if (cuts[0].end == k_no_end) return;
    const double distance = glm::distance(a.position, b.position);
    pairs_.push_back({cuts[0].score + 0.25 * distance / gap, a.end, b.end, cuts});
}

void LineStrokes::find_pairs(double gap, const LineDrawing& drawing, const std::stop_token& stop) {
    pairs_.clear();
    const double reach = k_max_overlap * gap;
    find_rows(reach);
    const LongCall call{stop, {}};
    for (std::size_t i = 0; i < ends_.size(); ++i) {
        if (i % k_ends_a_checkpoint == 0) call.checkpoint(0.0);
        any_beside(i, reach, [&](std::size_t j) {
            if (j > i && std::abs(ends_[j].position.y - ends_[i].position.y) <= reach)
                add_pair(i, j, gap, drawing);
            return false;
        });
    }
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
        if (a.score != b.score) return a.score < b.score;
        return a.a != b.a ? a.a < b.a : a.b < b.b;
    });
}

void LineStrokes::mate(const Pair& pair, double gap, const LineDrawing& drawing) {
    if (mates_[pair.a] != k_no_end || mates_[pair.b] != k_no_end) return;
    if (pair.cuts[0].end != k_no_end && !cut(pair.cuts[0], gap, drawing) &&
        !cut(pair.cuts[1], gap, drawing))
        return;
    mates_[pair.a] = pair.b;
    mates_[pair.b] = pair.a;
}

// Of a run that is cut, as much as the gap is left: else its ways are not those at its ends.
bool LineStrokes::cut(const Cut& cut, double gap, const LineDrawing& drawing) {
    if (cut.end == k_no_end) return false;
    const std::uint32_t run = cut.end / 2;
    double &begin = cut_begins_[run], &end = cut_ends_[run];
    const bool is_last = cut.end % 2 != 0;
    const double new_begin = is_last ? begin : cut.at, new_end = is_last ? cut.at : end;
    const std::span<const LinePoint> points = drawing.points_of(drawing.runs[run]);
    if (new_begin >= new_end || arc_at(points, new_end) - arc_at(points, new_begin) < gap)
        return false;
    begin = new_begin;
    end = new_end;
    return true;
}

// Returns the length of the part.
double LineStrokes::add_part(std::uint32_t run, bool is_reversed, LineDrawing& drawing) const {
    StrokePart part = drawing.whole(run, is_reversed);
    const double begin = cut_begins_[run], end = cut_ends_[run];
    double length = drawing.runs[run].length;
    if (begin > 0.0 || end < double(part.last_point - 1 - part.first_point))
        length = cut_part(begin, end, is_orthographic_, part, drawing);
    drawing.stroke_parts.push_back(part);
    return length;
}

void LineStrokes::follow(std::uint32_t first_end, bool is_closed, double min_length,
                         LineDrawing& drawing) {
    LineStroke stroke{.first_part = static_cast<std::uint32_t>(drawing.stroke_parts.size()),
                      .last_part = 0,
                      .is_closed = is_closed,
                      .length = 0.0};
    const std::size_t points = drawing.points.size();
    for (std::uint32_t end = first_end;;) {
        const std::uint32_t run = end / 2;
        is_done_[run] = 1;
        stroke.length += add_part(run, end % 2 != 0, drawing);
        const std::uint32_t next = mates_[end ^ 1u];
        if (next == k_no_end || is_done_[next / 2] != 0) break;
        end = next;
    }
    stroke.last_part = static_cast<std::uint32_t>(drawing.stroke_parts.size());
    if (stroke.length >= min_length) {
        drawing.strokes.push_back(stroke);
        return;
    }
    drawing.stroke_parts.resize(stroke.first_part);
    drawing.points.resize(points);
    drawing.sources.resize(points);
}

void LineStrokes::join(bool is_orthographic, const LineOptions& options, LineDrawing& drawing,
                       const std::stop_token& stop) {
    is_orthographic_ = is_orthographic;
    mates_.assign(2 * drawing.runs.size(), k_no_end);
    is_done_.assign(drawing.runs.size(), 0);
    cut_begins_.assign(drawing.runs.size(), 0.0);
    cut_ends_.clear();
    for (const LineRun& run : drawing.runs)
        cut_ends_.push_back(double(run.last_point - run.first_point) - 1.0);
    find_ends(options.gap, drawing);
    find_pairs(options.gap, drawing, stop);
    for (const Pair& pair : pairs_) mate(pair, options.gap, drawing);
    for (const bool closed : {false, true})
        for (std::uint32_t r = 0; r < drawing.runs.size(); ++r) {
            if (is_done_[r] != 0 || !drawing.runs[r].is_visible()) continue;
            if (is_loop(drawing, drawing.runs[r])) {
                follow(2 * r, true, options.min_length, drawing);
                continue;
            }
            for (std::uint32_t k = 0; k < 2 && is_done_[r] == 0; ++k)
                if (closed || mates_[2 * r + k] == k_no_end)
                    follow(2 * r + k, closed, options.min_length, drawing);
        }
}

}  // namespace rimline
