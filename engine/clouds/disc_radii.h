#pragma once

// Radii of the discs of a point cloud, so that together they cover its surface.

#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline {

/// One radius a point, in the units of the positions. Three discs at its corners cover a triangle if their
/// radius is that of its circumcircle or, if that is smaller, that of an equilateral triangle of its longest
/// side. A point gets the largest radius that its triangles need, up to twice their median. Where the surface
/// bends, gaps open between discs, because each lies in its own plane: so the radius of a triangle is
/// enlarged by the sine of its angle with that plane, up to 25 degrees (in `points shape:terrain:8000
/// --as-points --eye 2,3,4` 8 pixels show through, without this 326). Points without umbrellas get the median
/// over all points; 0 if no point has an umbrella. O(points).
std::vector<double> disc_radii(const PointSurface& surface);

}  // namespace rimline
