#pragma once

// Whether the backs of a mesh's faces can be seen from outside.
//
// A renderer that knows they cannot need not draw them, which is half of the faces. That a mesh is closed
// and consistently oriented does not tell: where it crosses itself, a ray from outside may meet a back first.

#include "silhouette/error.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Whether a mesh bounds a solid: every edge is regular, every shell of faces encloses a positive volume, and
/// no two faces meet but in the corners and edges that they share. The winding number around a point is
/// then the number of shells around it, so a ray from outside all of them meets the front of a face first.
///
/// Never true of a mesh of which that does not hold. False, too, where doubles cannot tell: faces without an
/// area, and faces nearer to each other than some 2^-40 of their size, or a shell as flat as that. And false
/// where a shell lines a hollow, and where it would take too long to know: where the boxes of more than 256
/// pairs of faces a face meet, and of more than 2^22 in all, as those of a fan of thousands do at its middle.
/// O(n log n), about a microsecond a face where faces are not much longer than wide, on all threads that
/// oneTBB gives. Throws Error{cancelled}.
bool is_solid(const Mesh& mesh, const LongCall& call = {});

}  // namespace rimline
