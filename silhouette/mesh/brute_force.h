#pragma once

// The silhouette by its definition: tests every face, then every edge. All other methods are tested
// against it. O(faces + edges).

#include <cstdint>
#include <vector>

#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The bits of all faces, packed as in face_bits.h.
std::vector<std::uint32_t> brute_force_face_bits(const Mesh& mesh, const HomogeneousPoint& point);

/// The silhouette's edges in ascending order, without borders.
std::vector<EdgeId> brute_force_silhouette(const Mesh& mesh, const HomogeneousPoint& point);

}  // namespace rimline
