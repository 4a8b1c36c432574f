#pragma once

// A coarser version of a mesh, to see how work grows with resolution.
//
// A cubic grid is laid over the mesh, all vertices in one cell become their mean, and triangles with two
// corners in one cell vanish (Rossignac, Borrel 1993). It keeps no topology: sheets that meet in a cell
// grow together, at edges of more than two faces. As a measure of work it is none the worse for that.

#include <cstdint>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline::tools {

/// The result of the finest grid, up to 2^16 cells along the longest side, that leaves no more than
/// `max_faces`. O((vertices + faces) * 16).
MeshSource cluster_vertices(const Mesh& mesh, std::uint32_t max_faces);

}  // namespace rimline::tools
