#pragma once

// Loop's subdivision: each step splits every triangle into four and smooths.
//
//            /\             a new vertex on each edge ab of triangles abc, abd:
//           /  \                3/8 (a + b) + 1/8 (c + d)
//          /____\           a vertex v with neighbors u_1 .. u_n moves to:
//         /\    /\              (1 - n beta) v + beta (u_1 + ... + u_n)
//        /  \  /  \             beta = 3/16 for n = 3, else 3 / (8 n)
//       /____\/____\        .
//
// C. Loop, Smooth Subdivision Surfaces Based on Triangles (1987), with Warren's simpler beta. Creases,
// which are borders and edges where more than two faces meet, follow the cubic B-spline of the crease:
// 1/2 (a + b) on an edge, 1/8 a + 3/4 v + 1/8 b at a vertex between two; a vertex where three creases
// or more meet stays. Both sides of a crease see the same curve, so open and non-manifold meshes
// refine without cracks. Orientation plays no part.

#include <cstdint>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// `steps` refinements of `source`, welded first (equal positions are one vertex): exactly 4^steps
/// times the faces, those of face f at 4^steps * f on, oriented as f. Degenerate triangles stay
/// degenerate where two corners are equal. The numbering of vertices is new, unused ones are gone.
/// The result's coordinates lie within the bounds of the source's. With no steps, `source` itself.
/// O(faces of the result) in time and memory. Throws Error{too_large} when the result would pass 2^28
/// faces, before anything is done, and Error{cancelled}.
MeshSource subdivide_loop(const MeshSource& source, std::uint32_t steps, const LongCall& call = {});

}  // namespace rimline
