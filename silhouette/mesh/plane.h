#pragma once

// The one truth: the face bit.
//
// A face is front as seen from p when p lies strictly on the outer side of its supporting plane:
//
//     front(f, p)  :=  (n.x*p.x + n.y*p.y) + n.z*p.z  >  w*d        float32, this order, no FMA
//
// n is the unit normal of the counter-clockwise triangle and d = n·v0, computed in double and rounded
// once. On the plane counts as back. The same expression stands in shaders/face_bit.glsl, and both
// give the same bit for every plane and point: everything else, silhouettes, updates and volumes, is
// derived from these bits, so rounding can move a silhouette by a triangle but never break one.
// (Definition 2.1.2, with the sign of the figures; its text before has it the other way round.)

#ifdef __FAST_MATH__
#error \
    "Rimline decides faces by exact float comparisons: compile what includes it without -ffast-math"
#endif

#include <array>
#include <glm/vec3.hpp>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// The supporting plane n·x = d. All zero where a triangle has none: such a face is always back.
struct Plane {
    float nx, ny, nz;
    float d;

    bool has_normal() const noexcept { return nx != 0.0f || ny != 0.0f || nz != 0.0f; }
};

/// Components of a normal below this are zero: 2^-16 of a float's own rounding of a unit vector.
/// Products with a point's components are then at least 2^-100 and their sums are multiples of 2^-123.
constexpr double k_min_normal_component = 0x1p-40;
/// The smallest normal float; a smaller |d| is zero.
constexpr double k_min_plane_distance = 0x1p-126;

/// The plane of a counter-clockwise triangle; all zero where its cross product is, in double.
Plane supporting_plane(const std::array<glm::vec3, 3>& corners) noexcept;

/// The face bit. Compile with -ffp-contract=off (linking rimline::silhouette does that).
inline bool is_front(const Plane& plane, const HomogeneousPoint& p) noexcept {
    return (plane.nx * p.x + plane.ny * p.y) + plane.nz * p.z > p.w * plane.d;
}

}  // namespace rimline
