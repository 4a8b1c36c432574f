#pragma once

// Where a face's plane lies in 3D Hough space: the foot of the perpendicular from the origin O.
//
//     dO = d - n·O        H = n * dO / |n|²
//
// The plane is taken as its rounded floats say, as the face bit does. They are not quite of unit
// length, and dividing by |n|² makes H the true foot point, so that what boxes around H prove holds for
// the rounded plane itself. (Thesis 3.2.1; a plane through the origin has H = 0.)

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "silhouette/mesh/plane.h"

namespace rimline {

struct HoughPoint {
    glm::dvec3 position;
    /// No coordinate of the exact foot point is farther from `position`'s than this.
    double error;
    /// The sign of the exact dO, which is that of the face's bit from the inside of a v-sphere; 0 where
    /// dO is so near to zero that its sign is not certain. The box position ± error then holds O itself.
    int side;
};

/// `plane` must have a normal.
//
// Products of two floats' worth of bits with a double, three sums: with v = 2^-53 the computed dO errs
// by at most 5v(|d| + |O|₁) =: e, rounded up to 2^-50(...). Each coordinate of H adds at most 8v|dO|,
// and |n_i|/|n|² <= 1 + 2^-22, so 2e bounds its error; |dO| <= e puts |H_i| below 2e as well.
inline HoughPoint hough_point(const Plane& plane, const glm::dvec3& origin) noexcept {
    const glm::dvec3 n(plane.nx, plane.ny, plane.nz);
    const double d = plane.d;
    const double distance = d - glm::dot(n, origin);
    const double error =
        0x1p-50 * (std::abs(d) + std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z));
    return {n * (distance / glm::dot(n, n)), 2.0 * error,
            distance > error ? 1 : (distance < -error ? -1 : 0)};
}

}  // namespace rimline
