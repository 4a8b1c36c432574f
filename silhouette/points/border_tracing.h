#pragma once

// Which gaps are borders of the surface.
//
// One point cannot tell: a hole of the sampling looks like the end of the surface. But a border is a closed
// curve. Each of its points names the two points that end its gap, and they name it back. So chains of such
// points are found, repaired, and kept where they close (thesis 5.2.5, but for whole chains):
//
//   border_gaps.h     the points whose stars have gaps, and which points these gaps name
//   border_repair.h   gaps are made consistent between neighbors, in six rounds at most
//   border_chains.h   the verdict of each chain: border, crease, or none
//   border_bend.h     points that stand back from their border are taken off it

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/points/open_point.h"
#include "silhouette/points/star_choice.h"

namespace rimline {

/// All points whose stars have gaps, ascending. `gap_ratio` as in PointSurfaceOptions. On all threads.
/// Throws Error{cancelled}.
std::vector<OpenPoint> trace_borders(std::span<const glm::dvec3> points,
                                     const NeighborLists& neighbors, const Stars& stars,
                                     double gap_ratio, const LongCall& call);

}  // namespace rimline
