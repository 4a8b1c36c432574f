#pragma once

// On which side of a plane a point lies, exactly.
//
// All coordinates are floats, so a product of two of them is exact in double. A sign is computed in double with
// a bound of its error, and where that does not decide, from an exact sum (exact_sum.h).
//
// Points of a picture often coincide: in a view along an axis of a machine part, most do. So the eye is moved
// by (e, e^2, e^3) with an e smaller than any number. Then a point lies on the plane of a triangle through the
// eye only where the triangle has no area (Edelsbrunner, Mücke, Simulation of Simplicity, 1990).

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// The error of (u x v) · w in double, as a share of the product of the lengths along the axes (|x| + |y| + |z|) of
/// three vectors that are differences of two floats: sixteen roundings.
constexpr double k_determinant_error = 0x1p-49;
inline double length_1(const glm::dvec3& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// The sign of ((b - a) x (c - a)) · (p - a): 1 where p sees a, b, c counter-clockwise, -1 clockwise, 0 where
/// the four lie on one plane.
int plane_side(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
               const glm::vec3& p) noexcept;

/// What plane_side() gives the sign of, with the same sign, correct to 2^-20 of it at least: six times the volume of the
/// tetrahedron.
double plane_height(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                    const glm::vec3& p) noexcept;

/// The sign of the first component of (b - a) x (c - a) that is not zero. 0 where the three lie on one line.
int first_normal_sign(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) noexcept;

/// 1 where `eye` sees a, b, c counter-clockwise, in other words c left of a -> b; -1 clockwise. The eye is
/// moved as said above, so 0 means that the three lie on one line.
int seen_side(const HomogeneousPoint& eye, const glm::vec3& a, const glm::vec3& b,
              const glm::vec3& c) noexcept;

/// The turn p -> q -> r of three points of one plane, which is projected along axis `drop` (0 to 2): 1 for
/// left, -1 for right, 0 for straight on.
int flat_turn(int drop, const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) noexcept;

/// The turn p -> q -> r in a plane, of coordinates that are floats: 1 for left, -1 for right, and 0 where double does not
/// decide it.
inline int certain_turn(const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) noexcept {
    const double left = (q.x - p.x) * (r.y - p.y), right = (q.y - p.y) * (r.x - p.x);
    // Four roundings of 2^-53 each, and no product is subnormal: differences of floats are 0 or above 2^-150.
    const double bound = 0x1p-50 * (std::abs(left) + std::abs(right));
    return left - right > bound ? 1 : (right - left > bound ? -1 : 0);
}

}  // namespace rimline
