#pragma once

// Normals for shading: smooth where the surface is smooth, sharp at its creases.
//
// The faces around a vertex form groups. Two faces that share a regular edge are in one group if the
// surface bends there by at most the crease angle. Each corner gets the mean of its group's face
// normals. The weight of a face is its angle at the vertex (Thuermer, Wuethrich 1998), so the mean does
// not depend on the triangulation.
//
// At the tip of a cone all faces are in one group, but their mean is the normal of none of them: light would
// spread from the tip over the cone. So where a face of a group is turned from the mean by more than the crease
// angle, each corner has its face's normal.
//
// These normals are for shading only. Planes decide which faces are front.

#include <cstdint>
#include <glm/vec3.hpp>
#include <stop_token>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// One unit normal per corner. Those of face f are elements 3f, 3f + 1, 3f + 2. All are finite and of
/// length 1 up to rounding. `crease_angle_rad` is in [0, pi]: 0 joins coplanar faces only, pi joins
/// all. Degenerate faces have weight 0. Their corners take a neighbor's normal, or +y if no neighbor
/// has one. O(n log n) for n faces of any valences, in practice O(n); most of it on all threads of oneTBB. The
/// result does not depend on their number. Throws Error{cancelled}.
std::vector<glm::vec3> corner_normals(const Mesh& mesh, float crease_angle_rad,
                                      const std::stop_token& stop = {});

/// The groups, for computing normals from other positions of the same triangles. Corner c of face f has
/// the number 3f + c. Group g holds corners[begin[g]] to corners[begin[g + 1]], ascending.
struct CornerGroupList {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> corners;
};
/// The groups that corner_normals() uses for the same mesh and angle. The same cost.
CornerGroupList corner_groups(const Mesh& mesh, float crease_angle_rad);

}  // namespace rimline
