#pragma once

// A model's octree, built with progress.

#include <string>

#include "silhouette/hough/hough_octree.h"
#include "tools/command.h"

namespace rimline::tools {

/// Errors name the model.
HoughOctree build_octree(const std::string& model, const Mesh& mesh, const Context& context,
                         const HoughOctreeOptions& options = {});
HoughOctree build_octree(const std::string&, Mesh&&, const Context&,
                         const HoughOctreeOptions& = {}) = delete;  // It would be gone.

}  // namespace rimline::tools
