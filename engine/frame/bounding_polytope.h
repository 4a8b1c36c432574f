#pragma once

// A polytope around the vertices of a mesh, closer than its box: a bust fills three quarters of the rectangle around it
// on the screen, and half of the rectangle around its box.
//
// It lies between two planes along each of 13 lines: the edges of the box, the diagonals of its sides, and its own.
// Source: Klosowski, Held, Mitchell, Sowizral, Zikan, Efficient Collision Detection Using Bounding Volume Hierarchies
// of k-DOPs, 1998.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

/// The corners of the polytope: the points lie in their convex hull, also as computed. 4 to about 60; none for no
/// points. O(points).
std::vector<glm::dvec3> polytope_around(std::span<const glm::vec3> points);

}  // namespace rimline
