#pragma once

// Viewpoints and directions of benches on turns around the model. See also spread_viewpoints.h.

#include <cstdint>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// The angle of a frame.
constexpr double k_orbit_step_degrees = 0.5;

/// A start and `frames` steps of half a degree around the model's up axis, at two radii.
std::vector<HomogeneousPoint> half_degree_orbit(const Mesh& mesh, std::uint32_t frames);
/// The same turn as directions.
std::vector<HomogeneousPoint> half_degree_turn(const Mesh& mesh, std::uint32_t frames);

}  // namespace rimline::tools
