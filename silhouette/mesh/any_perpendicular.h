#pragma once

// A direction at right angles to another, where any will do but always the same.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rimline {

/// Of length 1. `direction` is of length 1 too.
inline glm::dvec3 any_perpendicular(const glm::dvec3& direction) {
    return glm::normalize(glm::cross(
        direction, std::abs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

}  // namespace rimline
