#pragma once

// One direction perpendicular to another, always the same one for the same input.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rimline {

/// Returns a unit vector. `direction` must be a unit vector.
inline glm::dvec3 any_perpendicular(const glm::dvec3& direction) {
    return glm::normalize(glm::cross(
        direction, std::abs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

}  // namespace rimline
