#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rimline {

/// The relative error of positions in the shaders, with a margin. Relative to the camera or the light, positions are wrong
/// by about 2^-21 of their length: eight roundings of 2^-24, and a rotation matrix of floats. This is sixteen times that.
constexpr double k_shader_rounding = 0x1p-17;

/// The distance from a point to the farthest point of a box with `low` and `high`.
template <typename Box>
double reach_from(const Box& box, const glm::dvec3& point) {
    return glm::length(
        glm::max(glm::abs(glm::dvec3(box.low) - point), glm::abs(glm::dvec3(box.high) - point)));
}

}  // namespace rimline
