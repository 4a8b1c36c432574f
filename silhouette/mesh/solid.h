#pragma once

// Whether the backs of a mesh's faces can be seen from outside.
//
// If they cannot, a renderer can skip the back faces, which are half of all. A closed and consistently
// oriented mesh is not enough: if it intersects itself, a ray from outside may hit a back first.

#include "silhouette/error.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class FaceTree;

/// Whether a mesh bounds a solid: every edge is regular, every shell of faces encloses a positive volume, and
/// two faces meet only in the corners and edges that they share. The winding number of a point is then the
/// number of shells around it, so a ray from outside all shells hits the front of a face first.
///
/// The result is never true for other meshes. It is also false in these cases:
/// - Doubles cannot decide: a face has no area, two faces are closer than about 2^-40 of their size, or a
///   shell is that flat.
/// - A shell bounds a cavity.
/// - The test would take too long: the boxes of more than 2^22 pairs of faces overlap, and of more than 256
///   pairs per face. Thousands of long and thin faces beside each other cause this.
///
/// O(n log n), about 0.2 microseconds per face on two threads if faces are not much longer than wide. Uses all
/// threads of oneTBB. Throws Error{cancelled}.
bool is_solid(const Mesh& mesh, const LongCall& call = {});
/// The same with the tree of the mesh's faces, where there is one.
bool is_solid(const Mesh& mesh, const FaceTree& tree, const LongCall& call = {});

}  // namespace rimline
