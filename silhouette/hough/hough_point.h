#pragma once

// The point of a face's plane in 3D Hough space: the foot of the perpendicular from the origin O.
//
//     dO = d - n·O        H = n * dO / |n|²
//
// The plane is that of its rounded floats, as for the face bit. Their normal is not quite of unit length. The
// division by |n|² makes H the exact foot point, so that boxes around H are valid for the rounded plane
// itself. (Thesis 3.2.1. A plane through the origin has H = 0.)

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "silhouette/mesh/plane.h"

namespace rimline {

struct HoughPoint {
    glm::dvec3 position;
    /// Upper bound of the error of each coordinate of `position`.
    double error;
    /// The sign of the exact dO: the face's bit from inside a v-sphere. 0 where dO is so near to zero that
    /// its sign is not certain; then the box position ± error contains O.
    int side;
};

/// `plane` must have a normal.
//
// Three products of a float with a double, and three sums: with v = 2^-53 the computed dO errs by at most
// 5v(|d| + |O|₁) =: e, rounded up to 2^-50(...). Each coordinate of H adds at most 8v|dO|, and
// |n_i|/|n|² <= 1 + 2^-22. So 2e bounds its error. Where |dO| <= e, |H_i| is below 2e as well.
inline HoughPoint hough_point(const Plane& plane, const glm::dvec3& origin) noexcept {
    const glm::dvec3 n = plane.normal();
    const double d = plane.d;
    const double distance = d - glm::dot(n, origin);
    const double error =
        0x1p-50 * (std::abs(d) + std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z));
    return {n * (distance / glm::dot(n, n)), 2.0 * error,
            distance > error ? 1 : (distance < -error ? -1 : 0)};
}

}  // namespace rimline
