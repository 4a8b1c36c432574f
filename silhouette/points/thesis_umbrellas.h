#pragma once

// The umbrellas of PointSurfaceOptions::Method::thesis: the passes of 5.2. Each is a loop over points that
// reads the results of earlier passes, and never those of the current pass at another point.
//
//   1  Where the Gabriel triangle is trusted: an umbrella about it (thesis_fan.h).
//   2  Where that umbrella has a boundary, or the triangle was not trusted: umbrellas about the normals of
//      neighbors that have one whole umbrella, nearest first. A neighbor that one umbrella admits is in no
//      other, unless it lies on the boundary of the first. A neighbor on two boundaries is in no third. A new
//      umbrella without boundary is dropped if it has the fewest points; else it replaces all others. The
//      pass ends for a point when every boundary point lies on two boundaries, when no such neighbor remains,
//      or at four umbrellas.
//   3  Boundaries are made consistent with those of neighbors (5.2.5), as pass 2 left them. A point whose
//      umbrellas share all their boundary edges does not change: smooth patches meet there, or a crease ends.
//      A point without boundary, which the boundaries of two neighbors lead to, opens between these two: on
//      the side with fewer neighbors that have the point in their umbrellas. It loses the other neighbors on
//      that side. A point whose boundary edges are not returned takes the boundary edges that lead to it.
//      Where there are none, it fills its gap with neighbors that have it in their umbrellas.

#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

UmbrellaSet find_thesis_umbrellas(std::span<const glm::dvec3> points,
                                  const NeighborLists& neighbors,
                                  const PointSurfaceOptions& options, const LongCall& call);

}  // namespace rimline
