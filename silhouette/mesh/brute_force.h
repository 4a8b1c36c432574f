#pragma once

// The definition, written down as plainly as it can be: every face, then every edge. The oracle for
// everything else. O(faces + edges).

#include <cstdint>
#include <vector>

#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The face bits of every face, packed as face_bits.h says.
std::vector<std::uint32_t> brute_force_face_bits(const Mesh& mesh, const HomogeneousPoint& point);

/// The silhouette's edges, ascending. Borders are not among them.
std::vector<EdgeId> brute_force_silhouette(const Mesh& mesh, const HomogeneousPoint& point);

}  // namespace rimline
