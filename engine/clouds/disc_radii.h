#pragma once

// How wide the discs of a point cloud are, so that together they cover its surface.

#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline::tools {

/// In the units of the positions. Discs at its corners cover a triangle when they are as wide as the circle
/// through them, or where that is wider than that, as an equilateral triangle's of its longest side; a point's
/// is as wide as its widest triangle wants, up to twice the median. Where the surface bends discs part, as
/// each lies in a plane of its own: a triangle wants more by the sine of its angle with that plane, up to 25
/// degrees (of `points shape:terrain:8000 --as-points --eye 2,3,4` 8 pixels show through, where it was 326).
/// Points without umbrellas have the median over all points; zero where no point has one.
std::vector<double> disc_radii(const PointSurface& surface);

}  // namespace rimline::tools
