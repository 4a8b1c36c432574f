#pragma once

// How sharply the surface turns at each point, from 0 where it is flat to 1 for a right angle: the
// second-order difference of Hubeli and Gross (2001), as thesis 5.3 defines it for points.
//
// At an edge pq of p's umbrellas, two triangles of p meet, of one umbrella or of two. Their other corners r
// and s are the neighbors of q in p's ring. The weight of the edge is the angle between the normals of r and
// s, as a share of a right angle. Normals are unoriented, so the angle is at most a right one. The weight of
// a point is the maximum over its edges. A neighbor may have several umbrellas: then the normal nearest in
// direction to that of p's own umbrella is used.

#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline {

/// A weight in [0, 1] for each point; 0 where it is undecided. The same on any number of threads.
/// Throws Error{cancelled}.
std::vector<float> feature_weights(const PointSurface& surface, const LongCall& call = {});

}  // namespace rimline
