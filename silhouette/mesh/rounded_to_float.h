#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace rimline {

// The nearest floats, as doubles.

inline glm::dvec3 rounded_to_float(const glm::dvec3& v) { return glm::dvec3(glm::vec3(v)); }

inline glm::dmat3 rounded_to_float(const glm::dmat3& m) {
    return {rounded_to_float(m[0]), rounded_to_float(m[1]), rounded_to_float(m[2])};
}

}  // namespace rimline
