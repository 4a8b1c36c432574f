#pragma once

// Segments from the origin and triangles: distances, crossings, and the winding number of a closed mesh. All in
// double. What rounding leaves in doubt is said to be unknown.

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

using Corners = std::array<glm::dvec3, 3>;

/// The corners of a face, relative to `origin`.
Corners corners_from(const Mesh& mesh, FaceId face, const glm::dvec3& origin);

/// Of two segments: from the origin to `end`, and from a to b.
double distance_between(const glm::dvec3& end, const glm::dvec3& a, const glm::dvec3& b);

double distance_to_triangle(const glm::dvec3& point, const Corners& corners);

/// How a segment from the origin crosses a triangle. From_front: its end is on the side from which the corners are
/// counter-clockwise.
enum class Crossing { none, from_front, from_back, unknown };
Crossing crossing_of(const glm::dvec3& end, const Corners& corners);

/// How often a mesh whose triangles form a closed chain (is_closed_chain()) lies around `point`. Empty if a face
/// is nearer than `margin`, or if in each direction tried a crossing is unknown. Some microseconds.
std::optional<int> winding_number(const FaceTree& tree, const Mesh& mesh, const glm::dvec3& point,
                                  double margin);

}  // namespace rimline
