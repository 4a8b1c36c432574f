#pragma once

// The angle between two directions. Unlike the arc cosine, it is as accurate near 0 and π as
// elsewhere.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rimline {

/// In radians, from 0 to π. 0 if either vector is zero. The vectors may have any length.
inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace rimline
