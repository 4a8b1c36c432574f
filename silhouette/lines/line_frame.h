#pragma once

// All lines of one view with their invisibility: the number of faces strictly between the eye and a point of a
// line. It asks nothing of the mesh: not closed, not oriented, not manifold. In the order of the steps:
//
//   collect   line_collection.h   silhouettes, borders, creases and what else can hide; segments of
//                                 intersections
//   link      line_graph.h        lines that share a vertex
//   local     local_rule.h,
//             curve_rule.h        of each line its balance: its faces left of it minus those right of it in the
//                                 picture; of each end its own invisibility: how many faces at the vertex cover
//                                 the line there and lie in front of it
//   events    line_events.h       where the invisibility of a line changes: where it passes behind a line, by
//                                 the balance of that line, and where it meets a face that is not its own
//   spread    invisibility.h      invisibility at an end = base(vertex) + local(end). So the lines give the
//                                 differences of base between vertices. One ray gives its value for each set of
//                                 connected lines, and every cycle is a check
//
// All signs of edges are exact (exact_signs.h), from the view's point (LineView::point()). Segments of
// intersections have rounded ends.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_geometry.h"
#include "silhouette/lines/line_view.h"

namespace rimline {

constexpr std::uint32_t k_no_vertex = 0xffffffffu;
constexpr std::uint32_t k_no_chain = 0xffffffffu;

struct ViewLine {
    std::array<std::uint32_t, 2> vertices;  ///< k_no_vertex for a segment of an intersection.
    std::uint32_t source;  ///< The edge, or the segment (IntersectionCurves::segments()).
    LineKind kind;
    bool is_drawn;  ///< Lines that are not drawn hide others.
    /// Whether an end lies behind the eye. The line is cut before it, and at most one end is.
    std::array<bool, 2> is_cut;
    std::int32_t balance;

    bool is_intersection() const noexcept { return vertices[0] == k_no_vertex; }
};

/// A line in the picture seen from the view's point, from its first end to the second, without what is cut off.
struct FlatLine {
    std::array<glm::dvec2, 2> ends;
    std::array<double, 2> depths;
    std::array<double, 2> shares;  ///< Of the ends in space: 0 and 1 where nothing is cut off.

    /// The share of the line in space at a share of this segment in the picture.
    double share_in_space(double share, bool is_orthographic) const noexcept {
        const double s = is_orthographic
                             ? share
                             : share * depths[0] / (share * depths[0] + (1.0 - share) * depths[1]);
        return shares[0] + s * (shares[1] - shares[0]);
    }
    /// The inverse.
    double share_in_picture(double share, bool is_orthographic) const noexcept {
        const double s = (share - shares[0]) / (shares[1] - shares[0]);
        return is_orthographic ? s : s * depths[1] / (depths[0] + s * (depths[1] - depths[0]));
    }
};

struct LineEvent {
    std::uint32_t line;
    std::int32_t jump;  ///< Of the invisibility, from the first end to the second.
    double share;       ///< In the picture, of the FlatLine.
};

/// An end of a line: 2 * line, or 2 * line + 1 for the second end.
using LineEnd = std::uint32_t;

struct LineFrame {
    const LineGeometry* surface = nullptr;
    const LineView* view = nullptr;

    std::vector<ViewLine> lines;  ///< First the edges, then the segments of intersections.
    std::uint32_t edge_lines = 0;
    std::vector<FlatLine> flats;
    double picture_size = 0.0;  ///< The greatest coordinate in the picture.

    // Nodes: first the vertices of edges, then the nodes of intersections.
    std::vector<std::array<std::uint32_t, 2>> nodes;  ///< Of each line.
    std::vector<std::uint32_t> node_vertices;  ///< The mesh's vertex of each of the first nodes.
    std::vector<std::uint32_t> node_curves;    ///< The IntersectionCurves' node of each other one.
    std::vector<std::uint32_t> end_begin;      ///< Of each node, and one more.
    std::vector<LineEnd> ends;                 ///< Ends that are cut are at no node.

    std::vector<std::array<std::int32_t, 2>> locals;  ///< Of the ends of each line.
    /// By segment of an intersection: doubles do not decide one of its signs. A ray decides each of its pieces.
    std::vector<std::uint8_t> is_doubtful;
    std::vector<std::uint32_t> event_begin;  ///< Of each line, and one more.
    std::vector<LineEvent> events;           ///< By line, then by share.
    /// Pairs of drawn lines that may coincide in the picture, the lower number first. A pair may be there twice.
    std::vector<std::array<std::uint32_t, 2>> parallels;
    std::vector<std::int32_t> first_counts;  ///< The invisibility at the first end of each line.
    LineReport report;

    std::span<const LineEnd> ends_at(std::uint32_t node) const noexcept {
        return {ends.data() + end_begin[node], ends.data() + end_begin[node + 1]};
    }
    std::span<const LineEvent> events_of(std::uint32_t line) const noexcept {
        return {events.data() + event_begin[line], events.data() + event_begin[line + 1]};
    }
    bool is_line_doubtful(std::uint32_t line) const noexcept {
        return line >= edge_lines && is_doubtful[line - edge_lines] != 0;
    }
    void set_doubtful(std::uint32_t line) noexcept { is_doubtful[line - edge_lines] = 1; }
    /// The end of a line in space, before it is cut.
    glm::dvec3 end_of(const ViewLine& line, std::size_t end) const noexcept {
        if (!line.is_intersection()) return glm::dvec3(position(line.vertices[end]));
        const IntersectionCurves& curves = surface->curves();
        return curves.position(curves.segments()[line.source].nodes[end]);
    }
    const glm::vec3& position(std::uint32_t vertex) const noexcept {
        return surface->mesh().positions()[vertex];
    }
};

}  // namespace rimline
