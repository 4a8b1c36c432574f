#pragma once

// Which edges are valleys. A query for visible lines can skip valleys.
//
// Faces (a, b, c) and (b, a, d) share a regular edge ab. The edge is convex if d lies behind the plane of
// the first face, or equally if c lies behind the plane of the second. Both conditions are the sign of
//
//     det = (b - a) x (c - a) · (d - a)        < 0 convex, a ridge      > 0 concave, a valley
//
// The corners decide it, not the faces' rounded planes, so the two sides of an edge always agree. The
// determinant is computed in double, with Shewchuk's error bound (Adaptive Precision Floating-Point
// Arithmetic, 1997). An edge is flat if the determinant is within that bound. Edges of a face without
// area and edges between faces folded together are flat, too.
//
//         ___            \   /
//        /   \            \_/         front is outside, above
//     convex              concave
//
// Near a concave edge of a solid, the outside is the region where both faces are front. An outside point
// that sees the edge sees both faces from the front, so the edge is not on the silhouette. A concave edge
// on the silhouette is hidden by the solid itself (Bénard, Hertzmann, Line Drawings from 3D Models, 2019,
// 4.2). Conditions:
//
//   The mesh is closed, oriented outwards and free of self-intersections, and the point is outside it. On
//   an inside-out mesh ridges and valleys are exchanged, so the visible edges would be removed. On an open
//   mesh, or from inside, backs of faces are visible, and so are valleys between a front and a back face:
//   do not remove edges there.
//   If the point is within rounding error of a face's plane, the face's bit may be wrong (plane.h). A
//   removed edge may then be visible, next to a face seen edge-on.
//   Shadows need every edge of the silhouette: never remove edges for them.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

enum class EdgeConvexity : std::uint8_t {
    convex,   ///< A ridge, certain despite rounding.
    flat,     ///< Neither is certain.
    concave,  ///< A valley, certain despite rounding.
    none,     ///< Not a regular edge: no inside and outside is defined.
};

/// O(1).
EdgeConvexity edge_convexity(const Mesh& mesh, EdgeId edge) noexcept;

/// One bit per regular edge, set if it is concave. Edge e is bit e % 32 of word e / 32. Bits after the
/// last regular edge are 0. O(regular edges).
std::vector<std::uint32_t> concave_edge_bits(const Mesh& mesh);

/// The bit of any edge of the mesh. O(1).
inline bool is_concave(std::span<const std::uint32_t> concave_bits, EdgeId edge) noexcept {
    const std::uint32_t e = index(edge);
    return e / 32 < concave_bits.size() && (concave_bits[e / 32] >> (e % 32) & 1u) != 0;
}

/// Removes the edges whose bit is set from `edges`, and keeps the order of the others. `edges` may hold
/// any edges of the mesh in any order. Edges beyond the last word are not concave. Does not allocate.
/// O(edges).
void remove_concave_edges(std::span<const std::uint32_t> concave_bits, std::vector<EdgeId>& edges);

}  // namespace rimline
