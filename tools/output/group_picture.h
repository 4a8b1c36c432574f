#pragma once

// Figure 4.5: a model's faces colored by the origin they belong to, the origins as markers, and beside it
// the Hough points of each group relative to its own origin, in the same view.

#include <glm/vec3.hpp>

#include "silhouette/hough/hough_octree.h"
#include "tools/output/canvas.h"

namespace rimline::tools {

/// Of group i; after eight they come again.
Color group_color(std::size_t group);

/// Two squares of `side` pixels, seen along `towards_viewer` (not zero) with `up` upwards.
Canvas draw_groups(const HoughOctree& octree, const glm::dvec3& towards_viewer,
                   const glm::dvec3& up, int side);

}  // namespace rimline::tools
