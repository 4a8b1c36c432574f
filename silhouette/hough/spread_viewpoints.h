#pragma once

// Points and directions spread over the sphere, such as the silhouette points by which an index is measured.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Of `count` directions spread evenly over the sphere, on a spiral that turns by the golden angle, number `i`. Unit.
glm::dvec3 spread_direction(std::uint32_t i, std::uint32_t count);
/// Viewpoints spread evenly over the sphere by the golden angle, at one, two and three radii of the mesh in
/// turn. Throws Error{too_large} where one is beyond k_max_coordinate.
std::vector<HomogeneousPoint> spread_viewpoints(const Mesh& mesh, std::uint32_t count);
/// The same as directions.
std::vector<HomogeneousPoint> spread_directions(std::uint32_t count);

}  // namespace rimline
