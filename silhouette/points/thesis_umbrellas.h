#pragma once

// Umbrellas as PointSurfaceOptions::Method::thesis finds them: the passes of 5.2, each a loop over points
// that reads what earlier passes left and never another point's current pass.
//
//   1  Where the Gabriel triangle is trusted, an umbrella about it (thesis_fan.h).
//   2  Where that left a boundary or was not trusted, umbrellas about the normals of neighbors with one
//      whole umbrella, nearest first. A neighbor that an umbrella admits goes into no other, unless it
//      lies on its boundary; one on two boundaries goes into no third. An umbrella without a boundary
//      that has the fewest points is dropped, and else takes the place of all others. It ends when every
//      boundary point lies on two boundaries, no such neighbor remains, or there are four umbrellas.
//   3  Boundaries against those of neighbors (5.2.5). A point whose umbrellas share all their boundary
//      edges is left alone: smooth patches meet there, or a crease ends. One without boundary that two
//      neighbors' boundaries lead to opens between them, on the side with fewer neighbors that have it
//      in their umbrellas, and loses those there that have not. One whose boundary edges are not
//      returned takes those that lead to it, or where there are none fills its gap with neighbors that
//      have it in their umbrellas. Each point sees the others as pass 2 left them.

#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

UmbrellaSet find_thesis_umbrellas(std::span<const glm::dvec3> points,
                                  const NeighborLists& neighbors,
                                  const PointSurfaceOptions& options, const LongCall& call);

}  // namespace rimline
