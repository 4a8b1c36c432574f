#pragma once

// Which points of a cloud are seen from a viewpoint, without a surface: Katz, Tal and Basri, "Direct
// visibility of point sets" (2007).
//
// Every point is flipped outward through a sphere around the viewpoint, p -> p + 2 (R - |p|) p / |p|, so
// that near points come to lie far out. What is then on the convex hull of all and the viewpoint is seen.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline::tools {

/// The points seen, ascending. `sphere` is R in distances of the farthest point, above 1: the larger, the
/// more is seen. All of them where there are fewer than four, or the hull is flat.
/// Throws Error{too_large} where the hull cannot be found.
std::vector<std::uint32_t> visible_points(std::span<const glm::dvec3> positions,
                                          const glm::dvec3& viewpoint, double sphere = 100.0);

}  // namespace rimline::tools
