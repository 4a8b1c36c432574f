#pragma once

// Which side of a closed mesh its faces turn outwards.
//
// What looks at a solid from outside asks which faces turn towards it, so the corners have to be
// counter-clockwise as seen from outside. Some files have it the other way round; silhouettes and shadows do
// not mind, but a vote on front and back does. The sign of the volume that the faces enclose tells.

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The volume that the faces enclose, negative where they are wound clockwise as seen from outside; of an
/// open mesh, with the cones to the mesh's center added. O(faces).
double enclosed_volume(const Mesh& mesh);

/// Whether a mesh is closed, consistently oriented and encloses a negative volume. Of an open or an
/// inconsistently oriented mesh nobody can say: false.
bool is_inside_out(const Mesh& mesh);

/// The same mesh with all faces wound the other way. Vertices and faces keep their order; file_vertex()
/// gives the mesh's own numbers.
Mesh turned_inside_out(const Mesh& mesh);

}  // namespace rimline
