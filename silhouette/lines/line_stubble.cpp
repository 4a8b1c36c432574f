#include "silhouette/lines/line_stubble.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace rimline {

namespace {

// Chosen on the bunny's and the fandisk's pictures. Edges of a machine part bend by 20 times the noise and more.
constexpr double k_noise_factor = 3.0, k_crease_noise_factor = 6.0;
constexpr double k_crease_length_factor = 4.0;
// A stroke is a hook only of one that is so much longer.
constexpr double k_longer = 1.5;

// Calls visit(from, to) for each segment of a stroke.
template <typename Visit>
void each_segment(const LineDrawing& drawing, const LineStroke& stroke, Visit&& visit) {
    for (const StrokePart& part : drawing.parts_of(stroke)) {
        const std::span<const LinePoint> points = drawing.points_of(drawing.runs[part.run]);
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            visit(points[i].position, points[i + 1].position);
    }
}

bool is_crease(const LineDrawing& drawing, const LineStroke& stroke) {
    return std::ranges::all_of(drawing.parts_of(stroke), [&](const StrokePart& part) {
        return drawing.chains[drawing.runs[part.run].chain].kind == LineKind::crease;
    });
}

// Whether the edges of a stroke bend no more than the noise around them.
bool is_noise(const LineGeometry& surface, const LineDrawing& drawing, const LineStroke& stroke,
              double factor) {
    const Mesh& mesh = surface.mesh();
    const std::span<const float> bends = surface.bends_rad();
    double own = 0.0, others = 0.0;
    std::uint32_t edges = 0, other_edges = 0;
    for (const StrokePart& part : drawing.parts_of(stroke)) {
        const LineRun& run = drawing.runs[part.run];
        EdgeId last = k_no_edge;
        for (std::uint32_t i = run.first_point; i < run.last_point; ++i) {
            const EdgeId edge = drawing.sources[i].edge;
            if (edge == last) continue;
            // An intersection or a border is where surfaces meet or end: no noise.
            if (edge == k_no_edge || mesh.edge_class(edge) == EdgeClass::border) return false;
            last = edge;
            own += bends[index(edge)], ++edges;
            for (const FaceId face : mesh.faces_of(edge))
                for (const EdgeId other : mesh.edges_of(face))
                    if (other != edge) others += bends[index(other)], ++other_edges;
        }
    }
    return edges > 0 && other_edges > 0 && own / edges < factor * others / other_edges;
}

}  // namespace

void LineStubble::fill_grid(double gap, const LineDrawing& drawing) {
    segments_.clear();
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (std::uint32_t s = 0; s < drawing.strokes.size(); ++s)
        each_segment(drawing, drawing.strokes[s], [&](const glm::dvec2& a, const glm::dvec2& b) {
            segments_.push_back({a, b, s});
            low = glm::min(low, glm::min(a, b));
            high = glm::max(high, glm::max(a, b));
        });
    const glm::dvec2 size = high - low;
    const double count = double(segments_.size() + 1);
    grid_.reset(low, high, std::max(2.0 * gap, (size.x + size.y) / (2.0 * count)), gap);
    for (std::uint32_t i = 0; i < segments_.size(); ++i)
        grid_.add(i, segments_[i].from, segments_[i].to);
    grid_.finish();
}

template <typename IsOther>
bool LineStubble::is_near_another(const glm::dvec2& p, double gap, IsOther&& is_other) const {
    bool found = false;
    const auto visit = [&](std::uint32_t cell) {
        for (const std::uint32_t i : grid_.segments_in(cell)) {
            const auto& [a, b, stroke] = segments_[i];
            if (found || !is_other(stroke)) continue;
            const glm::dvec2 way = b - a;
            const double square = glm::dot(way, way);
            const double share =
                square > 0.0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0.0;
            found = glm::length(p - a - share * way) <= gap;
        }
    };
    grid_.each_cell(p, p, visit);
    return found;
}

// Whether both ends meet other strokes.
bool LineStubble::leads_on(std::uint32_t stroke, double gap, const LineDrawing& drawing) const {
    const auto parts = drawing.parts_of(drawing.strokes[stroke]);
    const auto end_of = [&](const StrokePart& part, bool is_last) {
        const auto points = drawing.points_of(drawing.runs[part.run]);
        return (is_last != part.is_reversed ? points.back() : points.front()).position;
    };
    const auto meets = [&](const glm::dvec2& p) {
        return is_near_another(p, gap, [&](std::uint32_t other) { return other != stroke; });
    };
    return meets(end_of(parts.front(), false)) && meets(end_of(parts.back(), true));
}

bool LineStubble::lies_beside_longer(std::uint32_t stroke, double gap,
                                     const LineDrawing& drawing) const {
    const double least = k_longer * drawing.strokes[stroke].length;
    const auto is_beside = [&](const glm::dvec2& p) {
        return is_near_another(p, gap, [&](std::uint32_t other) {
            return other != stroke && drawing.strokes[other].length >= least;
        });
    };
    bool all = true;
    each_segment(drawing, drawing.strokes[stroke], [&](const glm::dvec2& a, const glm::dvec2& b) {
        all = all && is_beside(a) && is_beside(0.5 * (a + b)) && is_beside(b);
    });
    return all;
}

void LineStubble::remove(const LineGeometry& surface, const LineOptions& options,
                         LineDrawing& drawing) {
    if (drawing.strokes.empty()) return;
    fill_grid(options.gap, drawing);
    std::vector<std::uint8_t> is_stubble(drawing.strokes.size(), 0);
    for (std::uint32_t s = 0; s < drawing.strokes.size(); ++s) {
        const LineStroke& stroke = drawing.strokes[s];
        const bool bends = is_crease(drawing, stroke);
        if (stroke.is_closed ||
            stroke.length >= options.stubble * (bends ? k_crease_length_factor : 1.0))
            continue;
        const double factor = bends ? k_crease_noise_factor : k_noise_factor;
        if (lies_beside_longer(s, options.gap, drawing) ||
            (is_noise(surface, drawing, stroke, factor) && !leads_on(s, options.gap, drawing)))
            is_stubble[s] = 1;
    }
    std::size_t kept = 0;
    for (std::size_t s = 0; s < is_stubble.size(); ++s)
        if (is_stubble[s] == 0) drawing.strokes[kept++] = drawing.strokes[s];
    drawing.strokes.resize(kept);
}

}  // namespace rimline
