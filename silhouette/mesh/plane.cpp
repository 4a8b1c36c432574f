#include "silhouette/mesh/plane.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rimline {

namespace {

float snapped(double value, double smallest) {
    return std::abs(value) < smallest ? 0.0f : static_cast<float>(value);
}

}  // namespace

Plane supporting_plane(const std::array<glm::vec3, 3>& corners) noexcept {
    const glm::dvec3 v0(corners[0]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(corners[1]) - v0, glm::dvec3(corners[2]) - v0);
    const double length = std::sqrt(glm::dot(normal, normal));
    if (!(length > 0.0)) return {0.0f, 0.0f, 0.0f, 0.0f};
    const glm::dvec3 n = normal / length;
    return {snapped(n.x, k_min_normal_component), snapped(n.y, k_min_normal_component),
            snapped(n.z, k_min_normal_component), snapped(glm::dot(n, v0), k_min_plane_distance)};
}

}  // namespace rimline
