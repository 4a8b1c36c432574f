#include "silhouette/lines/line_collection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "silhouette/error.h"

namespace rimline {

namespace {

// Lines are cut at this depth before a perspective eye, in radii of the mesh.
constexpr double k_near_share = 1e-5;
// So far ahead edges and their ends are asked for, which lie anywhere in memory.
constexpr std::size_t k_lines_ahead = 16;
// Two ends of each line are numbered, and one number is left for none (line_frame.h).
constexpr std::size_t k_max_lines = 0x7fffffff;

// Faces whose plane cannot tell on which side the point is: a plane's normal and distance are rounded to float,
// and so are the three products and sums. The bound is twice the sum of their errors.
void find_doubtful_faces(const Mesh& mesh, const HomogeneousPoint& p,
                         std::vector<std::uint32_t>& faces) {
    constexpr float k_error = 0x1p-21f;
    const float reach = std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
    const float own = k_error * reach + 0x1p-100f;
    const std::span<const Plane> planes = mesh.planes();
    constexpr std::size_t k_block = 64;
    for (std::size_t first = 0; first < planes.size(); first += k_block) {
        const std::size_t last = std::min(first + k_block, planes.size());
        const auto is_doubtful = [&](const Plane& plane) {
            const float distance = p.w * plane.d;
            const float value = (plane.nx * p.x + plane.ny * p.y) + plane.nz * p.z - distance;
            return std::abs(value) <= own + k_error * std::abs(distance);
        };
        int any = 0;  // A loop without branches becomes vectors.
        for (std::size_t f = first; f < last; ++f) any |= int(is_doubtful(planes[f]));
        if (any == 0) continue;
        for (std::size_t f = first; f < last; ++f)
            if (is_doubtful(planes[f])) faces.push_back(static_cast<std::uint32_t>(f));
    }
}

}  // namespace

void LineCollection::add_edge(EdgeId edge, LineKind kind, bool is_drawn, LineFrame& frame) {
    if (stamps_[index(edge)] == frame_number_) return;
    stamps_[index(edge)] = frame_number_;
    const auto& [v, w] = frame.surface->mesh().edge(edge).vertices;
    frame.lines.push_back({.vertices = {index(v), index(w)},
                           .source = index(edge),
                           .kind = kind,
                           .is_drawn = is_drawn,
                           .is_cut = {},
                           .balance = 0});
}

void LineCollection::add_edges_of_doubtful_faces(const LineOptions& options, LineFrame& frame) {
    const Mesh& mesh = frame.surface->mesh();
    doubtful_.clear();
    find_doubtful_faces(mesh, frame.view->point(), doubtful_);
    const bool is_drawn = options.draws[std::size_t(LineKind::silhouette)];
    for (const std::span<const std::uint32_t> faces :
         {std::span<const std::uint32_t>(doubtful_), frame.surface->slivers()})
        for (const std::uint32_t face : faces)
            for (const EdgeId edge : mesh.edges_of(FaceId{face}))
                if (edge != k_no_edge) add_edge(edge, LineKind::silhouette, is_drawn, frame);
}

// The same edges for all views of one angle.
void LineCollection::find_creases(float angle_rad, const LineGeometry& surface) {
    if (angle_rad == creases_angle_rad_) return;
    creases_angle_rad_ = -1.0f;  // Until the list is whole.
    creases_.clear();
    const std::span<const float> bends_rad = surface.bends_rad();
    for (std::uint32_t e = 0; e < bends_rad.size(); ++e)
        if (bends_rad[e] >= angle_rad && bends_rad[e] > 0.0f) creases_.push_back(EdgeId{e});
    creases_angle_rad_ = angle_rad;
}

void LineCollection::collect(std::span<const EdgeId> silhouette, const LineOptions& options,
                             LineFrame& frame) {
    const Mesh& mesh = frame.surface->mesh();
    RIMLINE_CHECK(options.shown_creases.empty() ||
                  options.shown_creases.size() == mesh.edge_count());
    for (const EdgeId edge : silhouette) RIMLINE_CHECK(index(edge) < mesh.edge_count());
    stamps_.resize(mesh.edge_count());
    ++frame_number_;
    frame.lines.clear();
    const auto draws = [&](LineKind kind) { return options.draws[std::size_t(kind)]; };
    const Mesh::EdgeRange borders = mesh.edges_of_class(EdgeClass::border);
    for (std::uint32_t e = borders.first; e < borders.last; ++e)
        add_edge(EdgeId{e}, LineKind::border, draws(LineKind::border), frame);
    for (std::size_t i = 0; i < silhouette.size(); ++i) {
        if (i + k_lines_ahead < silhouette.size()) {
            const EdgeId ahead = silhouette[i + k_lines_ahead];
            __builtin_prefetch(&stamps_[index(ahead)]);
            __builtin_prefetch(&mesh.edge(ahead));
        }
        add_edge(silhouette[i], LineKind::silhouette, draws(LineKind::silhouette), frame);
    }
    // Special edges first: local_rule.h would draw them as silhouettes where their balance is not zero.
    for (const EdgeId edge : frame.surface->special_edges())
        add_edge(edge, LineKind::crease, false, frame);
    add_edges_of_doubtful_faces(options, frame);
    if (draws(LineKind::crease)) {
        find_creases(options.crease_angle_rad, *frame.surface);
        const std::span<const std::uint8_t> shown = options.shown_creases;
        for (const EdgeId edge : creases_)
            if (shown.empty() || shown[index(edge)] != 0)
                add_edge(edge, LineKind::crease, true, frame);
    }
    const std::size_t count =
        draws(LineKind::intersection) ? frame.surface->curves().segments().size() : 0;
    if (frame.lines.size() + count > k_max_lines)
        throw Error(ErrorCode::too_large, "a view of 2^31 lines or more is too large to draw");
    frame.edge_lines = static_cast<std::uint32_t>(frame.lines.size());
    if (count > 0) {
        for (std::uint32_t i = 0; i < count; ++i)
            frame.lines.push_back({.vertices = {k_no_vertex, k_no_vertex},
                                   .source = i,
                                   .kind = LineKind::intersection,
                                   .is_drawn = true,
                                   .is_cut = {},
                                   .balance = 0});
    }
    project(frame);
}

void LineCollection::project(LineFrame& frame) const {
    const LineView& view = *frame.view;
    const double near = k_near_share * frame.surface->mesh().radius();
    frame.flats.clear();
    frame.picture_size = view.is_orthographic() ? 0.0 : 1.0;
    std::size_t kept = 0;
    std::uint32_t kept_edges = 0;
    for (std::size_t i = 0; i < frame.lines.size(); ++i) {
        if (i + k_lines_ahead < frame.edge_lines)
            for (const std::uint32_t vertex : frame.lines[i + k_lines_ahead].vertices)
                __builtin_prefetch(&frame.position(vertex));
        ViewLine line = frame.lines[i];
        std::array<glm::dvec3, 2> ends;
        for (std::size_t k = 0; k < 2; ++k) ends[k] = frame.end_of(line, k);
        FlatLine flat{.ends = {}, .depths = {}, .shares = {0.0, 1.0}};
        std::array<LineView::Projected, 2> seen{view.project_from_point(ends[0]),
                                                view.project_from_point(ends[1])};
        if (!view.is_orthographic()) {
            if (seen[0].depth <= near && seen[1].depth <= near) continue;
            for (std::size_t k = 0; k < 2; ++k) {
                if (seen[k].depth > near) continue;
                line.is_cut[k] = true;
                // A little behind the plane, so that rounding leaves the end before it.
                const double share =
                    (1.001 * near - seen[k].depth) / (seen[1 - k].depth - seen[k].depth);
                const double cut = std::clamp(share, 0.0, 1.0);
                flat.shares[k] = k == 0 ? cut : 1.0 - cut;
                seen[k] = view.project_from_point(glm::mix(ends[k], ends[1 - k], cut));
            }
        }
        for (std::size_t k = 0; k < 2; ++k) {
            flat.ends[k] = seen[k].position;
            flat.depths[k] = seen[k].depth;
            frame.picture_size =
                std::max({frame.picture_size, std::abs(flat.ends[k].x), std::abs(flat.ends[k].y)});
        }
        frame.lines[kept++] = line;
        frame.flats.push_back(flat);
        if (i < frame.edge_lines) ++kept_edges;
    }
    frame.lines.resize(kept);
    frame.edge_lines = kept_edges;
}

}  // namespace rimline
