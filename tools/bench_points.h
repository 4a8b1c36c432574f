#pragma once

// Where a bench looks from: points spread over the sphere, and turns around the model.

#include <cstdint>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// How far the point turns in a frame.
constexpr double k_orbit_step_degrees = 0.5;

/// Evenly over the sphere, by the golden angle; at one, two and three radii in turn.
std::vector<HomogeneousPoint> spread_viewpoints(const Mesh& mesh, std::uint32_t count);
/// The same as directions.
std::vector<HomogeneousPoint> spread_directions(std::uint32_t count);

/// A start and `frames` steps of half a degree around the model's up axis, at two radii.
std::vector<HomogeneousPoint> half_degree_orbit(const Mesh& mesh, std::uint32_t frames);
/// The same as directions.
std::vector<HomogeneousPoint> half_degree_turn(const Mesh& mesh, std::uint32_t frames);

}  // namespace rimline::tools
