#pragma once

// How sharply the surface turns at each point, from 0 where it is flat to 1 for a right angle: the
// second-order difference of Hubeli and Gross (2001), as thesis 5.3 has it for points.
//
// At an edge pq of p's umbrellas, two triangles of p meet, of one umbrella or of two. Their other corners
// r and s are q's neighbors in p's ring; the edge weighs the angle between their normals over a right
// angle. Normals are unoriented, so the angle is at most a right one. A point weighs what its heaviest
// edge does. Where a neighbor has several umbrellas, its normal is that of the umbrella nearest in
// direction to p's own where they meet.

#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline {

/// A weight in [0, 1] for each point; 0 where it is undecided. The same on any number of threads.
/// Throws Error{cancelled}.
std::vector<float> feature_weights(const PointSurface& surface, const LongCall& call = {});

}  // namespace rimline
