#pragma once

// The points of a cloud that are visible from a viewpoint, computed without a surface: Katz, Tal and Basri,
// "Direct visibility of point sets" (2007).
//
// Each point is reflected at a sphere of radius R around the viewpoint, p -> p + 2 (R - |p|) p / |p|, so
// that near points become the farthest. The points on the convex hull of the result and the viewpoint are
// visible.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline::tools {

/// The visible points, in ascending order. `sphere` is R divided by the distance of the farthest point,
/// above 1: with a larger sphere more points are visible. Returns all points if there are fewer than four or
/// if the hull is flat. Throws Error{too_large} if the hull cannot be computed.
std::vector<std::uint32_t> visible_points(std::span<const glm::dvec3> positions,
                                          const glm::dvec3& viewpoint, double sphere = 100.0);

}  // namespace rimline::tools
