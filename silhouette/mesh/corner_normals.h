#pragma once

// Normals to shade with: smooth where the surface is smooth, sharp where it has an edge.
//
// Around a vertex the faces fall into groups: two faces that share a regular edge are in one group
// when the surface bends there by no more than the crease angle. Each corner gets the mean of its
// group's face normals, weighted by the angle each face has at the vertex (Thuermer, Wuethrich 1998),
// which does not depend on how the surface is cut into triangles.
//
// For shading only: which faces are front is decided by planes, never by these.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// One unit normal for each corner: face f's are elements 3f, 3f + 1, 3f + 2. Always finite and of
/// length 1 but for rounding. `crease_angle_rad` lies in [0, pi]: 0 joins coplanar faces only, pi all.
/// Degenerate faces weigh nothing; their corners take a neighbor's normal, or +y where none has one.
/// O(faces) but for the inverse Ackermann function, whatever the valences.
std::vector<glm::vec3> corner_normals(const Mesh& mesh, float crease_angle_rad);

/// The groups themselves, for who computes normals from other positions of the same triangles. Corner c
/// of face f is number 3f + c; group g holds corners[begin[g]] to corners[begin[g + 1]], ascending.
struct CornerGroupList {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> corners;
};
/// The groups of corner_normals() for the same mesh and angle. O(faces), likewise.
CornerGroupList corner_groups(const Mesh& mesh, float crease_angle_rad);

}  // namespace rimline
