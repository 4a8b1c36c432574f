#pragma once

// Points and directions spread over the sphere: where silhouettes are looked at from to measure an index.

#include <cstdint>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Evenly over the sphere, by the golden angle; at one, two and three radii of the mesh in turn. Throws
/// Error{too_large} where that is beyond k_max_coordinate.
std::vector<HomogeneousPoint> spread_viewpoints(const Mesh& mesh, std::uint32_t count);
/// The same as directions.
std::vector<HomogeneousPoint> spread_directions(std::uint32_t count);

}  // namespace rimline
