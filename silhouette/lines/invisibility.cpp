#include "silhouette/lines/invisibility.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>

#include "silhouette/error.h"
#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

constexpr std::int32_t k_unknown_base = std::numeric_limits<std::int32_t>::min();

RayCount count_at(const LineFrame& frame, std::uint32_t line, double share_in_picture) {
    const LineGeometry& surface = *frame.surface;
    const double share =
        frame.flats[line].share_in_space(share_in_picture, frame.view->is_orthographic());
    if (frame.lines[line].is_intersection()) {
        const IntersectionCurves& curves = surface.curves();
        const auto& segment = curves.segments()[frame.lines[line].source];
        return count_before_point(
            surface, *frame.view,
            glm::mix(frame.end_of(frame.lines[line], 0), frame.end_of(frame.lines[line], 1), share),
            [&](std::uint32_t face) { return curves.is_own(segment, face); });
    }
    const auto [v, w] = frame.lines[line].vertices;
    const auto has = [&](std::uint32_t face, std::uint32_t vertex) {
        return has_corner(surface.mesh().triangles()[face], VertexId{vertex});
    };
    return count_before_point(
        surface, *frame.view,
        glm::mix(glm::dvec3(frame.position(v)), glm::dvec3(frame.position(w)), share),
        [&](std::uint32_t face) { return has(face, v) && has(face, w); });
}

// A ray that passes a border may be unsure where another one is not.
RayCount count_on_piece(const LineFrame& frame, std::uint32_t line, double begin, double end) {
    constexpr std::array k_shares{0.5, 0.38, 0.64, 0.27, 0.81};
    RayCount last{0, false};
    for (const double share : k_shares) {
        last = count_at(frame, line, begin + share * (end - begin));
        if (last.is_sure) break;
    }
    return last;
}

// The faces before a node of intersections, without those that contain it.
RayCount count_before_node(const LineFrame& frame, std::uint32_t node) {
    const IntersectionCurves& curves = frame.surface->curves();
    return count_before_point(*frame.surface, *frame.view, curves.position(node),
                              [&](std::uint32_t face) { return curves.contains(node, face); });
}

}  // namespace

// Gives base to all nodes that are connected with one. Returns whether all checks hold.
bool Invisibility::spread_from(std::uint32_t first, std::int32_t base, LineFrame& frame) {
    ++frame.report.components;
    bases_[first] = base;
    queue_.assign(1, first);
    bool holds = true;
    for (std::size_t head = 0; head < queue_.size(); ++head) {
        const std::uint32_t node = queue_[head];
        for (const LineEnd end : frame.ends_at(node)) {
            const std::uint32_t line = end / 2;
            const bool is_second = end % 2 != 0;
            if (frame.lines[line].is_cut[0] || frame.lines[line].is_cut[1]) continue;
            if (is_used_[line] != 0 || frame.is_line_doubtful(line)) continue;
            is_used_[line] = 1;
            const std::uint32_t other = frame.nodes[line][is_second ? 0 : 1];
            const std::int32_t next =
                is_second ? bases_[node] - steps_[line] : bases_[node] + steps_[line];
            if (bases_[other] == k_unknown_base) {
                bases_[other] = next;
                queue_.push_back(other);
            } else if (!check(bases_[other] == next, frame)) {
                holds = false;
            }
        }
    }
    return holds;
}

bool Invisibility::check(bool holds, LineFrame& frame) {
    ++frame.report.checks;
    if (!holds) ++frame.report.failed_checks;
    return holds;
}

void Invisibility::fail_component(const LineFrame& frame) {
    for (const std::uint32_t node : queue_)
        for (const LineEnd end : frame.ends_at(node)) has_failed_[end / 2] = 1;
}

// A ray is exact at a vertex.
void Invisibility::spread_edges(LineFrame& frame) {
    first_vertices_.clear();
    set_of_.resize(frame.node_vertices.size());
    for (std::uint32_t node = 0; node < frame.node_vertices.size(); ++node) {
        if (bases_[node] != k_unknown_base || frame.ends_at(node).empty()) continue;
        if (!spread_from(node, 0, frame)) fail_component(frame);
        for (const std::uint32_t other : queue_)
            set_of_[other] = static_cast<std::uint32_t>(first_vertices_.size());
        first_vertices_.push_back(frame.node_vertices[node]);
    }
    const std::span<const std::int32_t> counts =
        rays_.count_before(*frame.surface, *frame.view, first_vertices_);
    for (std::uint32_t node = 0; node < frame.node_vertices.size(); ++node)
        if (bases_[node] != k_unknown_base) bases_[node] += counts[set_of_[node]];
}

// A ray to a node of intersections may be unsure: then another node of the component may do. A second ray checks
// the component at its end, where no cycle does.
void Invisibility::spread_intersections(LineFrame& frame, const std::stop_token& stop) {
    const LongCall call{stop, {}};
    const auto first = static_cast<std::uint32_t>(frame.node_vertices.size());
    for (std::uint32_t node = first; node < bases_.size(); ++node) {
        if (bases_[node] != k_unknown_base || frame.ends_at(node).empty()) continue;
        call.checkpoint(0.0);  // A ray takes longer.
        const RayCount ray = count_before_node(frame, frame.node_curves[node - first]);
        if (!ray.is_sure) continue;
        bool holds = spread_from(node, ray.count, frame);
        if (queue_.size() > 1) {
            const std::uint32_t last = queue_.back();
            const RayCount second = count_before_node(frame, frame.node_curves[last - first]);
            if (second.is_sure) holds = check(second.count == bases_[last], frame) && holds;
        }
        if (!holds) fail_component(frame);
    }
}

void Invisibility::spread(LineFrame& frame, const std::stop_token& stop) {
    steps_.resize(frame.lines.size());
    has_failed_.assign(frame.lines.size(), 0);
    is_used_.assign(frame.lines.size(), 0);
    const auto jumps_of = [&](std::uint32_t line) {
        std::int32_t sum = 0;
        for (const LineEvent& event : frame.events_of(line)) sum += event.jump;
        return sum;
    };
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i)
        steps_[i] = frame.locals[i][0] - frame.locals[i][1] + jumps_of(i);
    bases_.assign(frame.end_begin.size() - 1, k_unknown_base);
    spread_edges(frame);
    spread_intersections(frame, stop);

    frame.first_counts.resize(frame.lines.size());
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i) {
        const auto& [first, second] = frame.nodes[i];
        const bool is_from_first = !frame.lines[i].is_cut[0];
        const std::int32_t base = bases_[is_from_first ? first : second];
        if (base == k_unknown_base || frame.is_line_doubtful(i)) has_failed_[i] = 1;
        frame.first_counts[i] = base == k_unknown_base ? 0
                                : is_from_first        ? base + frame.locals[i][0]
                                                       : base + frame.locals[i][1] - jumps_of(i);
    }
    decide_by_rays(frame, stop);
}

void Invisibility::decide_by_rays(LineFrame& frame, const std::stop_token& stop) {
    const LongCall call{stop, {}};
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i) {
        std::int32_t least = frame.first_counts[i];
        std::int32_t count = least;
        for (const LineEvent& event : frame.events_of(i))
            least = std::min(least, count += event.jump);
        // Below zero there is an error too.
        if (has_failed_[i] == 0 && least >= 0) continue;
        call.checkpoint(0.0);
        decide_by_ray_a_piece(i, frame);
    }
}

void Invisibility::decide_by_ray_a_piece(std::uint32_t line, LineFrame& frame) {
    const std::uint32_t first = frame.event_begin[line], last = frame.event_begin[line + 1];
    bool is_sure = true;
    double begin = 0.0;
    std::int32_t before = 0;
    for (std::uint32_t k = first; k <= last; ++k) {
        const double end = k < last ? frame.events[k].share : 1.0;
        // A piece without length has no middle of its own.
        std::int32_t count = before;
        if (end > begin || first == last) {
            const RayCount ray = count_on_piece(frame, line, begin, end);
            count = ray.count;
            is_sure = is_sure && ray.is_sure;
        }
        if (k == first)
            frame.first_counts[line] = count;
        else
            frame.events[k - 1].jump = count - before;
        before = count;
        begin = end;
    }
    ++frame.report.lines_by_rays;
    if (!is_sure) ++frame.report.undecided_lines;
}

}  // namespace rimline
