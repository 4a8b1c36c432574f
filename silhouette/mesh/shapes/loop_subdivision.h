#pragma once

// Loop's subdivision: each step splits every triangle into four and smooths the mesh.
//
//            /\             a new vertex on each edge ab of triangles abc, abd:
//           /  \                3/8 (a + b) + 1/8 (c + d)
//          /____\           a vertex v with neighbors u_1 .. u_n moves to:
//         /\    /\              (1 - n beta) v + beta (u_1 + ... + u_n)
//        /  \  /  \             beta = 3/16 for n = 3, else 3 / (8 n)
//       /____\/____\        .
//
// C. Loop, Smooth Subdivision Surfaces Based on Triangles (1987), with Warren's simpler beta. Creases
// are borders and edges with more than two faces. They follow a cubic B-spline: 1/2 (a + b) on an
// edge, 1/8 a + 3/4 v + 1/8 b at a vertex between two creases. A vertex of three or more creases does
// not move. Both sides of a crease get the same curve, so open and non-manifold meshes have no cracks.
// Orientation is not used.

#include <cstdint>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// Welds `source` (equal positions are one vertex) and refines it `steps` times. The result has
/// exactly 4^steps times the faces. Those of face f begin at 4^steps * f and have the orientation and
/// the material of f. A corner on an edge gets the mean color of the edge's two corners. Triangles
/// with two equal corners stay degenerate. Both halves of an edge are drawn when the edge is
/// (MeshSource::edge_codes), and new edges inside a face never. Warnings and files are those of
/// `source`. Vertices get new numbers, and unused ones are dropped. The coordinates stay within the
/// bounds of `source`. Zero steps return `source` unchanged. O(faces of the result) in time and
/// memory. Throws Error{too_large} at once if the result would have more than 2^28 faces, and
/// Error{cancelled}.
MeshSource subdivide_loop(const MeshSource& source, std::uint32_t steps, const LongCall& call = {});

}  // namespace rimline
