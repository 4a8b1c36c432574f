#pragma once

// A coarser version of a mesh, to measure how work grows with resolution.
//
// All vertices in one cell of a cubic grid become their mean; triangles with two corners in one cell are
// removed (Rossignac, Borrel 1993). The topology may change: sheets that meet in a cell are joined at edges
// of more than two faces. This does not matter for counting work.

#include <cstdint>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline::tools {

/// The result of the finest grid, of up to 2^16 cells along the longest side, with no more than `max_faces`
/// faces. O((vertices + faces) * 16).
MeshSource cluster_vertices(const Mesh& mesh, std::uint32_t max_faces);

}  // namespace rimline::tools
