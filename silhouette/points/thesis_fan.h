#pragma once

// One umbrella as the thesis makes it (5.2.1 to 5.2.3): from a normal and a radius, the neighbors near
// the plane, in order around it, with boundaries found before any is taken out and kept from then on.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/points/neighborhood.h"

namespace rimline {

/// The plane of the Gabriel triangle: of those on the point and its nearest neighbor, the one with the
/// smallest circumradius, which is the one with the greatest angle at its third corner; of equal ones,
/// that of the nearer.
struct GabrielTriangle {
    glm::dvec3 normal{0.0};  ///< Of length 1; zero where all neighbors lie on one line.
    double radius = 0.0;
    bool is_trusted = false;  ///< At least half of the k nearest lie within omega of its plane.
};
/// Of the `k` first of the list.
GabrielTriangle gabriel_triangle(const Neighborhood& around, std::uint32_t k, double omega);

/// Whether a neighbor belongs to an umbrella about the normal: within omega - omega_t of the plane, or
/// within omega + omega_t and nearer than gamma times the radius.
bool is_admissible(const Neighborhood& around, std::uint32_t place, const glm::dvec3& normal,
                   double radius, const PointSurfaceOptions& options);

/// The umbrella of the places. In this order: sectors wider than phi are gaps; edges are taken out whose
/// triangles turn more than omega from the normal, the worst first, unless what takes their place does
/// too; then edges that are not Delaunay; then gaps grow over triangles with a circumradius above gamma
/// times `radius`. Edges at gaps are never taken out, and each new sector may become a gap.
Fan thesis_fan(const Neighborhood& around, std::span<const std::uint8_t> places,
               const glm::dvec3& normal, double radius, const PointSurfaceOptions& options);

/// The places in order around the normal, sectors wider than `phi` gaps.
Fan ordered_fan(const Neighborhood& around, std::span<const std::uint8_t> places,
                const glm::dvec3& normal, double phi);

}  // namespace rimline
