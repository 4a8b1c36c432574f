#pragma once

// Preparation of a model for drawing and searching, with progress.

#include <string>

#include "silhouette/hough/hough_octree.h"
#include "tools/command.h"

namespace rimline::tools {

/// is_solid() with progress (silhouette/mesh/solid.h). Its cost pays off for many frames of one model.
bool check_solid(const Mesh& mesh, const Context& context);

/// Builds the octree. `mesh` must outlive it. Errors name the model.
HoughOctree build_octree(const std::string& model, const Mesh& mesh, const Context& context,
                         const HoughOctreeOptions& options = {});
HoughOctree build_octree(const std::string&, Mesh&&, const Context&,
                         const HoughOctreeOptions& = {}) =
    delete;  // A temporary mesh would dangle.

}  // namespace rimline::tools
