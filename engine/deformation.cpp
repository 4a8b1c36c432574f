#include "engine/deformation.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/mesh.h"

namespace rimline {

BoundingSphere bounding_sphere(const Mesh& mesh, const Deformation& deformation) {
    if (const auto* moved = std::get_if<MovedPositions>(&deformation))
        return {moved->center, moved->radius};
    const Wave& wave = std::get<Wave>(deformation);
    return {mesh.center(), mesh.radius() + std::abs(wave.amplitude)};
}

Wave default_wave(const Mesh& mesh, const glm::dvec3& up, double turns) {
    RIMLINE_CHECK(glm::length(up) > 0.0);
    const glm::dvec3 direction = glm::normalize(up);
    const glm::dvec3 x(1.0, 0.0, 0.0);
    const glm::dvec3 seed = std::abs(direction.x) < 0.9 ? x : glm::dvec3(0.0, 1.0, 0.0);
    const double radius = mesh.radius() > 0.0 ? mesh.radius() : 1.0;
    return {.center = mesh.center(),
            .direction = direction,
            .travel = glm::normalize(seed - direction * glm::dot(seed, direction)),
            .amplitude = 0.1 * radius,
            .length = 1.5 * radius,
            .turns = turns};
}

}  // namespace rimline
