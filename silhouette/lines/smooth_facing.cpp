#include "silhouette/lines/smooth_facing.h"

#include <glm/geometric.hpp>

namespace rimline {

double smooth_facing(const LineFrame& frame, std::uint32_t vertex) {
    const glm::dvec3 p(frame.position(vertex));
    glm::dvec3 normal(0.0);
    for (const auto& [a, b] : frame.surface->stars().links(vertex)) {
        const glm::dvec3 u = glm::dvec3(frame.position(a)) - p;
        const glm::dvec3 v = glm::dvec3(frame.position(b)) - p;
        const double weight = glm::dot(u, u) * glm::dot(v, v);
        if (weight > 0.0) normal += glm::cross(u, v) / weight;
    }
    const double length = glm::length(normal);
    if (length > 0.0) normal /= length;
    const glm::dvec3 eye(frame.view->point().xyz());
    return glm::dot(normal, frame.view->is_orthographic() ? eye : eye - p);
}

}  // namespace rimline
