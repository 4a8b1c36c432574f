#pragma once

// What is asked of a model before it is drawn or searched, with progress.

#include <string>

#include "silhouette/hough/hough_octree.h"
#include "tools/command.h"

namespace rimline::tools {

/// As is_solid(), for who draws many frames of it: silhouette/mesh/solid.h.
bool check_solid(const Mesh& mesh, const Context& context);

/// Errors name the model.
HoughOctree build_octree(const std::string& model, const Mesh& mesh, const Context& context,
                         const HoughOctreeOptions& options = {});
HoughOctree build_octree(const std::string&, Mesh&&, const Context&,
                         const HoughOctreeOptions& = {}) = delete;  // It would be gone.

}  // namespace rimline::tools
