#pragma once

// The face bit. All silhouettes are derived from it.
//
// A face is front as seen from p if p lies strictly on the outer side of its supporting plane:
//
//     front(f, p)  :=  (n.x*p.x + n.y*p.y) + n.z*p.z  >  w*d        float32, this order, no FMA
//
// n is the unit normal of the counter-clockwise triangle and d = n·v0. Both are computed in double and
// rounded once. A point on the plane sees the back. shaders/face_bit.glsl has the same expression, and
// both give the same bit for every plane and point. Silhouettes, updates and volumes use only these
// bits. Rounding can therefore move a silhouette by a triangle, but never break it. (Definition 2.1.2,
// with the sign of its figures. The text before it uses the opposite sign.)

#ifdef __FAST_MATH__
#error \
    "Rimline decides faces by exact float comparisons: compile what includes it without -ffast-math"
#endif

#include <array>
#include <glm/vec3.hpp>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// The supporting plane n·x = d. All zero if the triangle has none. Such a face is always back.
struct Plane {
    float nx, ny, nz;
    float d;

    glm::dvec3 normal() const noexcept { return {nx, ny, nz}; }
    bool has_normal() const noexcept { return nx != 0.0f || ny != 0.0f || nz != 0.0f; }
};

/// Smaller components of a normal are set to 0. The limit is 2^-16 times the rounding error of a unit
/// vector in float. Nonzero products with a point's components are then at least 2^-100, and their
/// sums are multiples of 2^-123.
constexpr double k_min_normal_component = 0x1p-40;
/// The smallest normal float. A smaller |d| is set to 0.
constexpr double k_min_plane_distance = 0x1p-126;

/// The plane of a counter-clockwise triangle. All zero if its cross product in double is zero.
Plane supporting_plane(const std::array<glm::vec3, 3>& corners) noexcept;

/// The face bit. Compile with -ffp-contract=off (linking rimline::silhouette does that).
inline bool is_front(const Plane& plane, const HomogeneousPoint& p) noexcept {
    return (plane.nx * p.x + plane.ny * p.y) + plane.nz * p.z > p.w * plane.d;
}

}  // namespace rimline
