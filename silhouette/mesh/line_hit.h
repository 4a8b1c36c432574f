#pragma once

// Where a line meets a face.

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "silhouette/mesh/mesh.h"

namespace rimline {

struct LineHit {
    double distance;  ///< From the line's start, in lengths of its direction; may be negative.
    double v, w;      ///< The shares of the second and third corner.
};

/// The line from `from` along `direction`. Nothing if it does not meet the face, or has the direction of its plane
/// (Möller, Trumbore, *Fast, Minimum Storage Ray/Triangle Intersection*, 1997).
inline std::optional<LineHit> meet(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& from,
                                   const glm::dvec3& direction) {
    const glm::dvec3 first = corners[1] - corners[0], second = corners[2] - corners[0];
    const glm::dvec3 across = glm::cross(direction, second);
    const double determinant = glm::dot(first, across);
    if (determinant == 0.0) return std::nullopt;
    const glm::dvec3 away = from - corners[0];
    const double v = glm::dot(away, across) / determinant;
    const glm::dvec3 turned = glm::cross(away, first);
    const double w = glm::dot(direction, turned) / determinant;
    if (!(v >= 0.0 && w >= 0.0 && v + w <= 1.0)) return std::nullopt;
    return LineHit{glm::dot(second, turned) / determinant, v, w};
}

inline std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, std::uint32_t face) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = glm::dvec3(mesh.positions()[index(mesh.triangles()[face][i])]);
    return corners;
}

}  // namespace rimline
