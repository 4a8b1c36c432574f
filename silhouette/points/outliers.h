#pragma once

// Points of a set that lie on none of its surfaces, as scans have them: reflections, dust, passers-by.
//
// A stray point harms more than itself. Those that lie beyond a border name its points as their neighbors, and close
// its gaps with triangles that their own scale allows.
//
// They cannot be told by their spacing alone, because many of them are each other's neighbors. But their umbrellas do
// not agree. So a surface is a set of 50 points or more that are connected by umbrellas which name each other, where
// their scales differ by at most a factor of 2 from one point to the next; only points count whom more than 60% of
// their ring name. What belongs to no surface, and lies farther from the nearest point of one than 2.75 times that
// point's scale, is an outlier.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/points/fan.h"
#include "silhouette/points/neighbor_lists.h"

namespace rimline {

/// One byte for each point, 1 for outliers. None where they would be more than a tenth of all points: then the points are
/// too few for their surface. `points` and `neighbors` in the order of OrderedPoints. O(n log n) on all threads. Throws
/// Error{cancelled}.
std::vector<std::uint8_t> find_outliers(std::span<const glm::dvec3> points,
                                        const NeighborLists& neighbors,
                                        const UmbrellaSet& umbrellas, const LongCall& call);

}  // namespace rimline
