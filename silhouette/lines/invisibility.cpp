#include "silhouette/lines/invisibility.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "silhouette/lines/face_count.h"

namespace rimline {

namespace {

constexpr std::int32_t k_unknown_base = std::numeric_limits<std::int32_t>::min();

RayCount count_at(const LineFrame& frame, std::uint32_t line, double share_in_picture) {
    const LineGeometry& surface = *frame.surface;
    const double share =
        frame.flats[line].share_in_space(share_in_picture, frame.view->is_orthographic());
    if (frame.lines[line].is_intersection()) {
        const auto& [ends, faces, piercings] = surface.intersections()[frame.lines[line].source];
        return count_before_point(
            surface, *frame.view, glm::mix(ends[0], ends[1], share),
            [&](std::uint32_t face) { return face == faces[0] || face == faces[1]; });
    }
    const auto [v, w] = frame.lines[line].vertices;
    const auto has = [&](std::uint32_t face, std::uint32_t vertex) {
        const Triangle& t = surface.mesh().triangles()[face];
        return index(t[0]) == vertex || index(t[1]) == vertex || index(t[2]) == vertex;
    };
    return count_before_point(
        surface, *frame.view,
        glm::mix(glm::dvec3(frame.position(v)), glm::dvec3(frame.position(w)), share),
        [&](std::uint32_t face) { return has(face, v) && has(face, w); });
}

}  // namespace

// Gives base to all nodes that are connected with one. Returns whether all checks hold.
bool Invisibility::spread_from(std::uint32_t first, LineFrame& frame) {
    ++frame.report.components;
    bases_[first] = count_before_vertex(*frame.surface, *frame.view, frame.node_vertices[first]);
    queue_.assign(1, first);
    bool holds = true;
    for (std::size_t head = 0; head < queue_.size(); ++head) {
        const std::uint32_t node = queue_[head];
        for (const LineEnd end : frame.ends_at(node)) {
            const std::uint32_t line = end / 2;
            const bool is_second = end % 2 != 0;
            if (frame.lines[line].is_cut[0] || frame.lines[line].is_cut[1]) continue;
            const std::uint32_t other = frame.nodes[line][is_second ? 0 : 1];
            const std::int32_t base =
                is_second ? bases_[node] - steps_[line] : bases_[node] + steps_[line];
            if (is_used_[line] != 0) continue;
            is_used_[line] = 1;
            if (bases_[other] == k_unknown_base) {
                bases_[other] = base;
                queue_.push_back(other);
            } else {
                ++frame.report.checks;
                if (bases_[other] != base) {
                    ++frame.report.failed_checks;
                    holds = false;
                }
            }
        }
    }
    return holds;
}

void Invisibility::spread(LineFrame& frame) {
    steps_.resize(frame.edge_lines);
    has_failed_.assign(frame.lines.size(), 0);
    is_used_.assign(frame.lines.size(), 0);
    const auto jumps_of = [&](std::uint32_t line) {
        std::int32_t sum = 0;
        for (const LineEvent& event : frame.events_of(line)) sum += event.jump;
        return sum;
    };
    for (std::uint32_t i = 0; i < frame.edge_lines; ++i)
        steps_[i] = frame.locals[i][0] - frame.locals[i][1] + jumps_of(i);
    bases_.assign(frame.node_vertices.size(), k_unknown_base);
    for (std::uint32_t node = 0; node < frame.node_vertices.size(); ++node)
        if (bases_[node] == k_unknown_base && !frame.ends_at(node).empty() &&
            !spread_from(node, frame))
            for (const std::uint32_t failed : queue_)
                for (const LineEnd end : frame.ends_at(failed)) has_failed_[end / 2] = 1;

    frame.first_counts.resize(frame.lines.size());
    for (std::uint32_t i = 0; i < frame.edge_lines; ++i) {
        const auto& [first, second] = frame.nodes[i];
        frame.first_counts[i] = !frame.lines[i].is_cut[0]
                                    ? bases_[first] + frame.locals[i][0]
                                    : bases_[second] + frame.locals[i][1] - jumps_of(i);
    }
    decide_by_rays(frame);
}

void Invisibility::decide_by_rays(LineFrame& frame) {
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i) {
        const bool is_intersection = i >= frame.edge_lines;
        std::int32_t least = is_intersection ? 0 : frame.first_counts[i];
        std::int32_t count = least;
        for (const LineEvent& event : frame.events_of(i))
            least = std::min(least, count += event.jump);
        // Below zero there is an error too.
        if (is_intersection || has_failed_[i] != 0 || least < 0) decide_by_ray_a_piece(i, frame);
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
            const RayCount ray = count_at(frame, line, 0.5 * (begin + end));
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
    if (!frame.lines[line].is_intersection()) ++frame.report.lines_by_rays;
    if (!is_sure) ++frame.report.undecided_lines;
}

}  // namespace rimline
