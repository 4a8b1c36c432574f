#pragma once

// Normals as they are commonly estimated: that of the least-squares plane of a point and its k nearest
// neighbors (Hoppe et al. 1992). The normals of umbrellas are compared with them. Near another sheet or
// across an edge the plane fits neither side.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

/// Of length 1 and unoriented; zero where the neighbors define no plane. `positions` as for PointSurface, k
/// from 4 to 32. O(n log n) on all threads. Throws Error{cancelled}.
std::vector<glm::dvec3> pca_normals(std::span<const glm::dvec3> positions, std::uint32_t k,
                                    const LongCall& call = {});

}  // namespace rimline
