#pragma once

// Points on creases, where smooth patches meet, get one umbrella for each patch.
//
// The triangles of a point's star lie on both sides of a crease through it. So the star falls into two sectors, three
// at a corner, each nearly plane, with a turn of at least 30 degrees from one to the next. On a smooth surface with few
// samples a star falls apart in the same way. There, however, the surface turns on: the points inside a sector have
// normals that turn away from it by half the turn between the sectors, while along a crease they have its normal.
//
// A crease goes on at both ends of a sector. Of the sectors' common ends at least one is a point of a crease too.

#include <glm/vec3.hpp>
#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

/// Interior points of creases become feature points. Their umbrellas are divided where the sectors meet, so that all
/// triangles stay. `points` and `neighbors` in the order of OrderedPoints. O(n) on all threads. Throws
/// Error{cancelled}.
void split_at_creases(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                      UmbrellaSet& found, const LongCall& call);

}  // namespace rimline
