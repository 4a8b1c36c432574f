#pragma once

// What people use to find the borders of a cloud (PCL's BoundaryEstimation, Open3D's
// compute_boundary_points): a point is on the border where its neighbors, projected into the plane fitted
// to them, leave a sector wider than a threshold. An implementation of our own, to compare with.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline::tools {

/// The widest sector, in radians, of each point's 16 nearest neighbors; 2 π where they have no plane.
/// `positions` are distinct.
std::vector<double> widest_sectors(std::span<const glm::dvec3> positions);

}  // namespace rimline::tools
