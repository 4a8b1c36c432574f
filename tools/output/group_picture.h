#pragma once

// Figure 4.5 of the thesis. Left: the faces of a model, colored by the origin that they belong to, and the
// origins as markers. Right: the Hough points of each group relative to its origin, in the same view.

#include <glm/vec3.hpp>

#include "silhouette/hough/hough_octree.h"
#include "tools/output/canvas.h"

namespace rimline::tools {

/// Colors repeat after eight groups.
Color group_color(std::size_t group);

/// Two squares of `side` pixels, viewed from the direction `towards_viewer` (not zero), with their axes and a
/// bar in the model's units. `up` points upwards. Origins are numbered from 1.
Canvas draw_groups(const HoughOctree& octree, const glm::dvec3& towards_viewer,
                   const glm::dvec3& up, int side);

}  // namespace rimline::tools
