#pragma once

// Which way a mesh faces: people, animals, heads and machines have more detail in front than behind.
//
//   Detail. A direction shows the mean bending of the faces that are turned to it: of each face, half of the angles of
//     its regular edges times their lengths, the integral of its mean curvature, by its area. Normals are smoothed over
//     twelve rounds of neighbors, so that neither the noise of scans nor the edges of coarse meshes count. Twelve
//     directions around `up`, ten degrees above the ground, are compared by their first harmonic.
//   Convention. Files whose up direction is known, or is y as in most, mostly have the front in front (ground_axes.h).
//   Symmetry. A mesh that is symmetric across one axis of the ground alone looks along the other one, one way or the
//     other.
//
// The weights were chosen on 22 meshes with a face or a front: of six of this project's models and 16 of CGAL's. The
// detail alone is within 24 degrees of the front for the nine with the clearest harmonic, more than a tenth of the mean;
// among the thirteen others it is wrong for five.

#include <glm/vec3.hpp>
#include <stop_token>

#include "silhouette/mesh/mesh.h"

namespace rimline {

struct FrontSide {
    glm::dvec3 towards{
        0.0};  ///< From the mesh, perpendicular to up, of length 1; zero if nothing tells.
    double certainty = 0.0;  ///< 0 to 1.
};

/// `up` must not be zero. O(faces): 20 ms for 100,000 on one thread. Throws Error{cancelled}.
FrontSide find_front_side(const Mesh& mesh, const glm::dvec3& up, const std::stop_token& stop = {});

}  // namespace rimline
