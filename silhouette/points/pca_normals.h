#pragma once

// Normals as they are commonly estimated: of the plane that fits a point and its k nearest neighbors
// best (Hoppe et al. 1992). To compare umbrellas' with: near another sheet or over an edge the plane fits
// neither.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

/// Of length 1, either way round; zero where the neighbors give none. `positions` as PointSurface takes
/// them, k from 4 to 32. O(n log n) on all threads. Throws Error{cancelled}.
std::vector<glm::dvec3> pca_normals(std::span<const glm::dvec3> positions, std::uint32_t k,
                                    const LongCall& call = {});

}  // namespace rimline
