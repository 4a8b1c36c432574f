#pragma once

// The edges along which a point set's surface ends.
//
// Umbrellas of neighbors need not agree on where a border is. An edge counts where both its points say so:
// both are labeled border, and each has an umbrella in which a gap and a triangle meet at the spoke to the
// other.

#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline {

/// Each edge once, ascending. O(umbrellas log umbrellas).
std::vector<PointEdge> border_edges(const PointSurface& surface);

}  // namespace rimline
