#pragma once

// Whether the faces of a closed mesh face outwards.
//
// Corners must be counter-clockwise as seen from outside, so that faces towards an outside viewer are front.
// Some files use the opposite order. It does not affect silhouettes and shadows, but it affects votes on
// front and back. The sign of the enclosed volume tells the order.

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The volume that the faces enclose. It is negative if they are wound clockwise as seen from outside. For
/// an open mesh, cones from its borders to its center close it. O(faces).
double enclosed_volume(const Mesh& mesh);

/// Whether a mesh is closed, consistently oriented and encloses a negative volume. False for an open or
/// inconsistently oriented mesh, where it is not defined.
bool is_inside_out(const Mesh& mesh);

/// The same mesh with all faces wound in the opposite order. Vertices and faces keep their order.
/// file_vertex() of the result gives vertex numbers of `mesh`.
Mesh turned_inside_out(const Mesh& mesh);

}  // namespace rimline
