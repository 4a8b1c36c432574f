#include "silhouette/lines/smooth_contour.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/lines/smooth_facing.h"

namespace rimline {

void SmoothContour::begin(const LineFrame& frame, double tolerance, float crease_angle_rad) {
    frame_ = &frame;
    tolerance_ = tolerance;
    crease_angle_rad_ = crease_angle_rad;
    const std::size_t vertices = frame.surface->mesh().vertex_count();
    facing_stamps_.resize(vertices);
    shift_stamps_.resize(vertices);
    facings_.resize(vertices);
    shifts_.resize(vertices);
    ++view_number_;
}

glm::dvec2 SmoothContour::shift_of(std::uint32_t vertex) {
    if (shift_stamps_[vertex] != view_number_) {
        shift_stamps_[vertex] = view_number_;
        shifts_[vertex] = find_shift(vertex);
    }
    return shifts_[vertex];
}

double SmoothContour::facing_of(std::uint32_t vertex) {
    if (facing_stamps_[vertex] == view_number_) return facings_[vertex];
    facing_stamps_[vertex] = view_number_;
    return facings_[vertex] = smooth_facing(*frame_, vertex);
}

bool SmoothContour::is_at_crease(std::uint32_t vertex) const {
    const Mesh& mesh = frame_->surface->mesh();
    for (const std::uint32_t face : frame_->surface->stars().faces(vertex))
        for (const EdgeId edge : mesh.edges_of(FaceId{face})) {
            const auto& [v, w] = mesh.edge(edge).vertices;
            if ((index(v) == vertex || index(w) == vertex) &&
                frame_->surface->bends_rad()[index(edge)] >= crease_angle_rad_)
                return true;
        }
    return false;
}

glm::dvec2 SmoothContour::find_shift(std::uint32_t vertex) {
    if (is_at_crease(vertex)) return glm::dvec2(0.0);
    const LineView& view = *frame_->view;
    const auto at = [&](std::uint32_t v) { return glm::dvec3(frame_->position(v)); };
    const glm::dvec2 from = view.project(at(vertex)).position;
    double nearest = -1.0;
    glm::dvec2 shift(0.0);
    for (const auto& [a, b] : frame_->surface->stars().links(vertex)) {
        const std::array<std::uint32_t, 3> corners{vertex, a, b};
        // The contour crosses two sides of a face, or none.
        std::array<glm::dvec2, 2> ends;
        std::size_t count = 0;
        for (std::size_t k = 0; k < 3 && count < 2; ++k) {
            const std::uint32_t v = corners[k], w = corners[(k + 1) % 3];
            const double f = facing_of(v), g = facing_of(w);
            if ((f > 0.0) == (g > 0.0)) continue;
            const LineView::Projected place = view.project(glm::mix(at(v), at(w), f / (f - g)));
            if (!view.is_orthographic() && !(place.depth > 0.0)) continue;
            ends[count++] = place.position;
        }
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
