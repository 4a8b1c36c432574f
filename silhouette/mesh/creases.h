#pragma once

// Creases: edges where the surface bends by more than a given angle. Both ridges and valleys are
// creases. Unlike a silhouette, they do not depend on the viewpoint.
//
//      n0 ^   / n1         bend = the angle between the normals: 0 where the faces are coplanar,
//         |  /                    90 degrees at the edge of a cube, 180 where they are folded together
//     ____|_/
//           \.
//            \.
//
// If both faces traverse the edge in the same direction, coplanar ones have opposite normals. The
// second normal is then negated. If three or more faces meet, there is no single surface. The bend is
// then the largest angle between the first face's plane and another face's plane, in either
// orientation.

#include <stop_token>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

struct Crease {
    EdgeId edge;
    float bend_rad;  ///< In [0, pi].
};

/// The bend of an edge in [0, pi]; 0 at a border, and between faces without a normal.
double bend_of(const Mesh& mesh, EdgeId edge);

/// The edges with a bend of at least `min_bend_rad`, sharpest first, equal ones by number. Excludes
/// borders and edges between faces without a normal. Throws Error{cancelled} when `stop` is requested. O(edges) plus
/// a sort of the result.
std::vector<Crease> find_creases(const Mesh& mesh, float min_bend_rad,
                                 const std::stop_token& stop = {});

}  // namespace rimline
