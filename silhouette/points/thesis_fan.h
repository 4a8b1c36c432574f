#pragma once

// One umbrella as the thesis makes it (5.2.1 to 5.2.3), from a normal and a radius: the neighbors near the
// plane, in order around the normal. Boundaries are found before any neighbor is removed, and are kept from
// then on.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "silhouette/points/neighborhood.h"

namespace rimline {

/// The plane of the Gabriel triangle. Of the triangles with the point and its nearest neighbor as corners, it
/// is the one with the minimum circumradius, so with the maximum angle at its third corner. Of equal ones it
/// is that with the nearer third corner.
struct GabrielTriangle {
    glm::dvec3 normal{0.0};  ///< Of length 1; zero where all neighbors lie on one line.
    double radius = 0.0;
    bool is_trusted = false;  ///< At least half of the k nearest lie within omega of its plane.
};
/// Uses the `k` first of the list.
GabrielTriangle gabriel_triangle(const Neighborhood& around, std::uint32_t k, double omega);

/// Whether a neighbor may be in an umbrella about the normal: its edge makes at most omega - omega_t with the
/// plane, or at most omega + omega_t and is shorter than gamma times the radius.
bool is_admissible(const Neighborhood& around, std::uint32_t place, const glm::dvec3& normal,
                   double radius, const PointSurfaceOptions& options);

/// The umbrella of the places, in four steps. Sectors wider than phi become gaps. Edges are removed whose two
/// triangles both turn more than omega from the normal, the worst first, unless the triangle that replaces
/// them does so too. Edges that are not Delaunay are removed. Gaps grow over triangles with a circumradius above
/// gamma times `radius`. Edges at gaps are never removed, and each new sector may become a gap.
Fan thesis_fan(const Neighborhood& around, std::span<const std::uint8_t> places,
               const glm::dvec3& normal, double radius, const PointSurfaceOptions& options);

/// The umbrella of those places `among` the list that are admissible. Nothing where it has no triangle.
std::optional<Fan> admitted_fan(const Neighborhood& around, std::uint64_t among,
                                const glm::dvec3& normal, double radius,
                                const PointSurfaceOptions& options);

/// The places in order around the normal. Sectors wider than `phi` are gaps.
Fan ordered_fan(const Neighborhood& around, std::span<const std::uint8_t> places,
                const glm::dvec3& normal, double phi);

}  // namespace rimline
