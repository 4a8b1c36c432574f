#pragma once

// The edges of a mesh as shaders read them (gpu::EdgeRecord, shaders/layout.h).

#include <vector>

#include "shaders/layout.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Both faces of a regular edge; of any other edge the first face alone.
gpu::EdgeRecord edge_record(const Mesh& mesh, EdgeId edge);

/// edge_record() of all edges, by edge number.
std::vector<gpu::EdgeRecord> edge_records(const Mesh& mesh);

/// One record for each face of each edge that is not regular, in the direction in which the face traverses
/// the edge: each of these faces casts its own shadow side.
std::vector<gpu::EdgeRecord> loose_edge_records(const Mesh& mesh);

}  // namespace rimline
