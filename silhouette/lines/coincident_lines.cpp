#include "silhouette/lines/coincident_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/error.h"
#include "silhouette/lines/cross_2d.h"

namespace rimline {

namespace {

constexpr double k_shifts = 4.0;
constexpr std::size_t k_parallels_a_checkpoint = 1u << 16;
// Nearer than this many radii, things of a mesh lie in front of each other by as much as they are far away.
constexpr double k_near_radii = 4.0;
// In tolerances. Lines that turn from each other are near to each other on a stretch of one tolerance over the turn.
constexpr double k_min_stretch = 100.0;
// A line is seen end-on where its picture is at most this long for what it extends along the view.
constexpr double k_max_slope_end_on = 1.0 / 16.0;

// A line whose picture is as short may also be a short line, as those of a small thing in a large scene are.
bool is_end_on(const FlatLine& flat, bool is_orthographic, double tolerance) {
    const double length = glm::length(flat.ends[1] - flat.ends[0]);
    if (length > tolerance) return false;
    const double depth = std::abs(flat.depths[1] - flat.depths[0]);
    const double nearest = std::min(flat.depths[0], flat.depths[1]);
    return length * (is_orthographic ? 1.0 : nearest) <= k_max_slope_end_on * depth;
}

}  // namespace

double coincidence_tolerance(const LineFrame& frame) {
    const LineView& view = *frame.view;
    const Mesh& mesh = frame.surface->mesh();
    if (view.is_orthographic()) return k_shifts * view.shift() * mesh.radius();
    const double distance = drawn_distance(mesh, view.eye());
    return k_shifts * view.shift() / distance *
           std::min(1.0, k_near_radii * mesh.radius() / distance);
}

bool may_coincide(const FlatLine& a, const FlatLine& b, double tolerance) noexcept {
    const glm::dvec2 u = a.ends[1] - a.ends[0], v = b.ends[1] - b.ends[0];
    const double turn = cross_2d(u, v), uu = glm::dot(u, u), vv = glm::dot(v, v);
    constexpr double k_max_sine = 2.0 / k_min_stretch;
    if (turn * turn > k_max_sine * k_max_sine * uu * vv) return false;
    // Lines of a chain follow each other. cover() wants an overlap of two tolerances along one of the two, of which
    // there is more than one along the other: they turn from each other by a sine of 0.02 at most.
    const double first = glm::dot(u, b.ends[0] - a.ends[0]),
                 last = glm::dot(u, b.ends[1] - a.ends[0]);
    const double overlap =
        std::min(std::max(first, last), uu) - std::max(std::min(first, last), 0.0);
    if (overlap <= 0.0 || overlap * overlap <= tolerance * tolerance * uu) return false;
    // Whether the line through one of them comes near to the other.
    const auto is_near = [&](const FlatLine& line, const glm::dvec2& way, double square,
                             const FlatLine& other) {
        const double p = cross_2d(way, other.ends[0] - line.ends[0]);
        const double q = cross_2d(way, other.ends[1] - line.ends[0]);
        const double least = (p > 0.0) == (q > 0.0) ? std::min(std::abs(p), std::abs(q)) : 0.0;
        return least * least <= tolerance * tolerance * square;
    };
    return is_near(a, u, uu, b) || is_near(b, v, vv, a);
}

void CoincidentLines::find_stretches(const LineFrame& frame, std::uint32_t line,
                                     std::vector<Stretch>& stretches) {
    stretches.clear();
    const FlatLine& flat = frame.flats[line];
    double begin = 0.0;
    std::int32_t count = frame.first_counts[line];
    const auto add = [&](double end) {
        if (end <= begin) return;
        const glm::dvec2 from = glm::mix(flat.ends[0], flat.ends[1], begin);
        const glm::dvec2 to = glm::mix(flat.ends[0], flat.ends[1], end);
        stretches.push_back({line, {from, to}, begin, end, glm::length(to - from), count > 0});
    };
    for (const LineEvent& event : frame.events_of(line)) {
        if ((count > 0) != (count + event.jump > 0)) {
            add(event.share);
            begin = event.share;
        }
        count += event.jump;
    }
    add(1.0);
}

void CoincidentLines::cover(const Stretch& own, const Stretch& other, double tolerance) {
    if (own.length <= tolerance) return;
    const glm::dvec2 along = (own.ends[1] - own.ends[0]) / own.length;
    const glm::dvec2 a = other.ends[0] - own.ends[0], b = other.ends[1] - own.ends[0];
    if (std::abs(cross_2d(along, a)) > tolerance || std::abs(cross_2d(along, b)) > tolerance)
        return;
    double first = glm::dot(along, a), last = glm::dot(along, b);
    if (first > last) std::swap(first, last);
    first = std::max(first, 0.0);
    last = std::min(last, own.length);
    // Lines that share an end and go on overlap in less than the tolerance.
    if (last - first <= 2.0 * tolerance) return;
    const auto share_at = [&](double place) {
        return own.begin + (own.end - own.begin) * (place / own.length);
    };
    found_.push_back({own.line, first <= tolerance ? own.begin : share_at(first),
                      last >= own.length - tolerance ? own.end : share_at(last)});
}

void CoincidentLines::find(LineFrame& frame, CoveredStretches& covered,
                           const std::stop_token& stop) {
    covered.clear();
    found_.clear();
    const double tolerance = coincidence_tolerance(frame);
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i) {
        // Its picture is a point.
        if (frame.lines[i].is_drawn &&
            is_end_on(frame.flats[i], frame.view->is_orthographic(), tolerance))
            found_.push_back({i, 0.0, 1.0});
    }
    std::sort(frame.parallels.begin(), frame.parallels.end());
    const auto last = std::unique(frame.parallels.begin(), frame.parallels.end());
    frame.parallels.erase(last, frame.parallels.end());
    std::size_t until_checkpoint = 0;
    for (const auto& [i, j] : frame.parallels) {
        if (until_checkpoint-- == 0) {
            LongCall{stop, {}}.checkpoint(0.0);
            until_checkpoint = k_parallels_a_checkpoint;
        }
        find_stretches(frame, i, stretches_);
        find_stretches(frame, j, others_);
        // Of two that are both visible or both hidden the first stays.
        for (const Stretch& own : stretches_)
            for (const Stretch& other : others_)
                if (own.is_hidden && !other.is_hidden)
                    cover(own, other, tolerance);
                else
                    cover(other, own, tolerance);
    }
    if (found_.empty()) return;
    std::sort(found_.begin(), found_.end(), [](const CoveredStretch& a, const CoveredStretch& b) {
        return a.line != b.line ? a.line < b.line : a.begin < b.begin;
    });
    covered.begin_.assign(frame.lines.size() + 1, 0);
    for (const CoveredStretch& stretch : found_) {
        if (!covered.stretches_.empty() && covered.stretches_.back().line == stretch.line &&
            covered.stretches_.back().end >= stretch.begin) {
            covered.stretches_.back().end = std::max(covered.stretches_.back().end, stretch.end);
            continue;
        }
        covered.stretches_.push_back(stretch);
        ++covered.begin_[stretch.line + 1];
    }
    for (std::size_t i = 0; i < frame.lines.size(); ++i) covered.begin_[i + 1] += covered.begin_[i];
}

}  // namespace rimline
