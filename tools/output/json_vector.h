#pragma once

// Vectors in JSON output are lists of three numbers.

#include <array>
#include <glm/vec3.hpp>

namespace rimline::tools {

inline std::array<double, 3> json_vector(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace rimline::tools
