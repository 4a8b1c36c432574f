#pragma once

// Points and directions spread over the sphere: the silhouette points by which an index is measured.

#include <cstdint>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Viewpoints spread evenly over the sphere by the golden angle, at one, two and three radii of the mesh in
/// turn. Throws Error{too_large} where one is beyond k_max_coordinate.
std::vector<HomogeneousPoint> spread_viewpoints(const Mesh& mesh, std::uint32_t count);
/// The same as directions.
std::vector<HomogeneousPoint> spread_directions(std::uint32_t count);

}  // namespace rimline
