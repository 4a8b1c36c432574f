#pragma once

// A mesh with fewer faces.

#include <cstdint>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline::tools {

/// A mesh with about `faces` faces, by edge collapses with least quadric error (meshoptimizer; Garland,
/// Heckbert 1997); of more than a million faces, vertices in one cell of a grid are joined first. More remain where the
/// topology does not allow fewer, and fewer of separate small parts. Vertices are some of the mesh's, in its order. A
/// face has the material and the colors of one at its corners, without textures. `mesh` has at least so many faces.
/// About 0.7 microseconds a face up to a million, and 0.2 beyond. Throws Error{cancelled}, but not within a step of up
/// to a second.
MeshSource simplified(const Mesh& mesh, std::uint32_t faces, const LongCall& call = {});

}  // namespace rimline::tools
