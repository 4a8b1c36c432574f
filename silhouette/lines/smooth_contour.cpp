#include "silhouette/lines/smooth_contour.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace rimline {

void SmoothContour::begin(const LineFrame& frame, double tolerance, float crease_angle_rad,
                          SmoothNormals& normals) {
    frame_ = &frame;
    normals_ = &normals;
    tolerance_ = tolerance;
    crease_angle_rad_ = crease_angle_rad;
}

glm::dvec2 SmoothContour::shift_of(std::uint32_t vertex) {
    if (frame_->surface->sharpest_bends_rad()[vertex] >= crease_angle_rad_) return glm::dvec2(0.0);
    const LineView& view = *frame_->view;
    const auto at = [&](std::uint32_t v) { return glm::dvec3(frame_->position(v)); };
    const glm::dvec3 own = at(vertex);
    const double own_facing = normals_->facing(vertex);
    const glm::dvec2 from = view.project(own).position;

    // Of a neighbor: how it faces the eye, and where the contour crosses the edge to it.
    struct Spoke {
        std::uint32_t vertex = k_no_vertex;
        double facing = 0.0;
        std::optional<glm::dvec2> crossing;
    };
    const auto crossing_of = [&](const glm::dvec3& a, double f, const glm::dvec3& b,
                                 double g) -> std::optional<glm::dvec2> {
        if ((f > 0.0) == (g > 0.0)) return {};
        const LineView::Projected place = view.project(glm::mix(a, b, f / (f - g)));
        if (!view.is_orthographic() && !(place.depth > 0.0)) return {};
        return place.position;
    };
    const auto spoke_to = [&](std::uint32_t v) {
        Spoke spoke{v, normals_->facing(v), {}};
        spoke.crossing = crossing_of(own, own_facing, at(v), spoke.facing);
        return spoke;
    };

    double nearest = -1.0;
    glm::dvec2 shift(0.0);
    Spoke last;
    for (const auto& [a, b] : frame_->surface->stars().links(vertex)) {
        const Spoke first = a == last.vertex ? last : spoke_to(a);
        last = spoke_to(b);
        // The contour crosses two sides of a face, or none.
        std::array<glm::dvec2, 2> ends;
        std::size_t count = 0;
        for (const std::optional<glm::dvec2>& crossing : {first.crossing, last.crossing})
            if (crossing) ends[count++] = *crossing;
        if (count == 1)
            if (const auto side = crossing_of(at(a), first.facing, at(b), last.facing))
                ends[count++] = *side;
        if (count < 2) continue;
        const glm::dvec2 way = ends[1] - ends[0];
        const double square = glm::dot(way, way);
        const double share =
            square > 0.0 ? std::clamp(glm::dot(from - ends[0], way) / square, 0.0, 1.0) : 0.0;
        const glm::dvec2 to = ends[0] + share * way - from;
        const double distance = glm::length(to);
        if (nearest < 0.0 || distance < nearest) nearest = distance, shift = to;
    }
    return nearest > tolerance_ ? shift * (tolerance_ / nearest) : shift;
}

}  // namespace rimline
