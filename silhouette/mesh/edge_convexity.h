#pragma once

// Which edges are valleys: what a query for visible lines may leave out.
//
// Faces (a, b, c) and (b, a, d) share a regular edge ab. Whether d lies behind the plane of the first and
// whether c lies behind the plane of the second is one question, as both ask for the sign of
//
//     det = (b - a) x (c - a) · (d - a)        < 0 convex, a ridge      > 0 concave, a valley
//
// It is asked of the corners themselves, not of the faces' rounded planes, so the two sides of an edge
// never disagree. In double, with Shewchuk's bound of its error (Adaptive Precision Floating-Point
// Arithmetic, 1997): nearer to zero than that, the edge is flat. Flat are also edges of a face without
// area and faces folded onto each other.
//
//         ___            \   /
//        /   \            \_/         front is outside, above
//     convex              concave
//
// Beside a concave edge of a solid, outside is where both faces are front. A point outside that sees the
// edge is there and sees both faces front, so the edge is not on the silhouette; where it is, the solid
// itself hides it (Bénard, Hertzmann, Line Drawings from 3D Models, 2019, 4.2). What that needs:
//
//   The mesh is closed, oriented outwards and free of self-intersections, and the point is outside it. On
//   a mesh turned inside out ridges and valleys change places, and what would be removed is just what is
//   visible. On an open mesh, or from inside, one sees the backs of faces, and valleys that part a front
//   face from a back one are visible: remove none there.
//   Where the point is within rounding of a face's plane its bit may be the wrong one (plane.h), and a
//   removed edge may be seen edge-on, beside a face of no visible width.
//   Shadows need every edge of the silhouette: never remove any for them.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

enum class EdgeConvexity : std::uint8_t {
    convex,   ///< Certainly a ridge.
    flat,     ///< Neither is certain.
    concave,  ///< Certainly a valley.
    none,     ///< Not a regular edge: inside and outside have no sides there.
};

/// O(1).
EdgeConvexity edge_convexity(const Mesh& mesh, EdgeId edge) noexcept;

/// One bit for each regular edge, set where it is concave: edge e is bit e % 32 of word e / 32. Bits past
/// the last regular edge are zero. O(regular edges).
std::vector<std::uint32_t> concave_edge_bits(const Mesh& mesh);

/// Removes from `edges`, which may be any of the mesh in any order, those whose bit is set; the rest stay
/// in order. Edges beyond the last word are not concave. Does not allocate. O(edges).
void remove_concave_edges(std::span<const std::uint32_t> concave_bits, std::vector<EdgeId>& edges);

}  // namespace rimline
