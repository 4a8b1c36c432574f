#pragma once

// The angle between two directions, as exact near 0 and π as elsewhere, which the arc cosine is not.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rimline {

/// In radians, from 0 to π; 0 where either is zero. Lengths do not matter.
inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace rimline
