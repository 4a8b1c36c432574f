#pragma once

// An order in which neighboring edges have nearly the same planes. The trees of cones and of quadrics use it.

#include <vector>

#include "silhouette/mesh/ids.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The regular edges whose two faces have a plane, in packed_order of the planes' mean in plane space
/// about the mesh's center (plane_tree.h). O(edges log edges).
std::vector<EdgeId> edges_by_plane(const Mesh& mesh);

}  // namespace rimline
