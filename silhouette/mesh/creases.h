#pragma once

// Creases: edges over which a surface bends by more than an angle, ridges and valleys alike. Unlike a
// silhouette they do not depend on the viewer.
//
//      n0 ^   / n1         bend = the angle between the normals: 0 where the surface goes on plane,
//         |  /                    90 degrees at the edge of a cube, 180 where it folds back onto itself
//     ____|_/
//           \.
//            \.
//
// Faces that run an edge the same way have opposite normals where the surface goes on: of those the
// second is turned round. Where three faces or more meet there is no one surface; such an edge bends as
// much as the plane that differs most from that of its first face, either way round.

#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

struct Crease {
    EdgeId edge;
    float bend_rad;  ///< In [0, pi].
};

/// The edges that bend by at least `min_bend_rad`, sharpest first, equal ones by their number. Borders
/// and edges of faces without a normal are none. O(edges), and a sort of what is returned.
std::vector<Crease> find_creases(const Mesh& mesh, float min_bend_rad);

}  // namespace rimline
