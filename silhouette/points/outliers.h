#pragma once

// Points of a set that lie on none of its surfaces, as scans have them: reflections, dust, passers-by.
//
// A stray point harms more than itself. Those that lie beyond a border name its points as their neighbors, and close
// its gaps with triangles that their own scale allows.
//
// They cannot be told by their spacing, because many of them are each other's neighbors. But their umbrellas do not
// agree. Points are connected by umbrellas which name each other, where their scales differ by at most a factor of 2;
// only points count whom more than 60% of their ring name. The agreement of such a set is the sum of |n n'| over the
// points of its set that name a point and that it names, in the mean over its points: on a smooth surface about 6, the
// size of a ring, and on strays at most 2.8, because only half of a ring names a point, and normals have any direction.
// A surface is a set of 100 points or more with an agreement of 2.8 or more, one of 20 points or more with 3.4, and the
// largest set if it has 50 points. What belongs to no surface, and lies farther from the nearest point of one than 2.75
// times that point's scale, is an outlier.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/points/fan.h"
#include "silhouette/points/neighbor_lists.h"

namespace rimline {

/// One byte for each point, 1 for outliers. None where they would be more than a tenth of all points: then the points
/// are too few for their surface. `points` and `neighbors` in the order of OrderedPoints. O(n log n) on all threads.
/// Throws Error{cancelled}.
std::vector<std::uint8_t> find_outliers(std::span<const glm::dvec3> points,
                                        const NeighborLists& neighbors,
                                        const UmbrellaSet& umbrellas, const LongCall& call);

}  // namespace rimline
