#pragma once

// Edges in an order in which close ones have nearly the same planes: what the trees of cones and of
// quadrics are built over.

#include <vector>

#include "silhouette/mesh/ids.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Regular edges whose faces both have a plane, in packed_order of the planes' mean in plane space
/// about the mesh's center (plane_tree.h). O(edges log edges).
std::vector<EdgeId> edges_by_plane(const Mesh& mesh);

}  // namespace rimline
