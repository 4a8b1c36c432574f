#pragma once

// A mesh with fewer faces.

#include <cstdint>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline::tools {

/// A mesh with about `faces` faces, by edge collapses with least quadric error (meshoptimizer; Garland,
/// Heckbert 1997); of more than a million faces, vertices in one cell of a grid are joined first. More remain where the
/// topology does not allow fewer. A face has the material and the colors of one at its corners, without textures.
/// `mesh` has at least so many faces. About 0.7 microseconds a face, at most 1 s.
MeshSource simplified(const Mesh& mesh, std::uint32_t faces);

}  // namespace rimline::tools
