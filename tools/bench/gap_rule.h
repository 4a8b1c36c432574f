#pragma once

// The common rule for borders of a cloud (PCL's BoundaryEstimation, Open3D's compute_boundary_points): a
// point is on the border where its neighbors, projected into the plane fitted to them, leave a sector wider
// than a threshold. This is our own implementation, for comparison.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline::tools {

/// The widest sector, in radians, between each point's 16 nearest neighbors; 2 π where no plane fits them.
/// `positions` must be distinct.
std::vector<double> widest_sectors(std::span<const glm::dvec3> positions);

}  // namespace rimline::tools
