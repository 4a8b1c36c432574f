#pragma once

#include <cstdint>

#include "silhouette/lines/line_frame.h"

namespace rimline {

/// Greater than 0 where the smooth surface through a vertex shows its front to the view's point, less than 0 where
/// it shows its back. It is linear in the vertex's normal, so that it can be interpolated along an edge. The normal has
/// length 1, and the direction of a sum of those of the faces, with the weights for which it is exact on a sphere (Max,
/// Weights for Computing Vertex Normals from Facet Normals, 1999). O(faces of the vertex).
double smooth_facing(const LineFrame& frame, std::uint32_t vertex);

}  // namespace rimline
