#pragma once

// The edges along which a point set's surface ends, and those along which its smooth patches meet.
//
// Umbrellas of neighbors need not agree on where a border or a crease is. An edge counts where both its points say so:
// both have the label, and each has an umbrella in which a gap and a triangle meet at the spoke to the other.

#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline {

/// Each edge once, ascending. O(umbrellas log umbrellas).
std::vector<PointEdge> border_edges(const PointSurface& surface);
/// The same, between feature points.
std::vector<PointEdge> crease_edges(const PointSurface& surface);

}  // namespace rimline
