#pragma once

// The corners of the faces whose front a camera may see, for CPU devices: there the vertices of faces take most of a
// frame's time, and backs are culled only after theirs were computed. A GPU computes them beside other work.

#include <cstdint>
#include <span>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Writes the numbers of the corners (three a face) of all faces in front of whose plane the camera is, or so near to it
/// that rounding may decide, and returns how many. `camera` in the mesh's coordinates; `corners` has space for those of
/// all faces. O(faces): about 1 ns a face.
std::uint32_t put_front_corners(const Mesh& mesh, const HomogeneousPoint& camera,
                                std::span<std::uint32_t> corners);

}  // namespace rimline
