#pragma once

// The face bit of a triangle whose corners move: decided from the corners alone, for no plane outlives
// a frame.
//
//     front(v0, v1, v2, p)  :=  ((v1 - v0) x (v2 - v0)) · (p - w*v0)  >  0
//
// In float32, in one order, without FMA. The same expression stands in shaders/moving_face.glsl, and both
// give the same bit for all corners and points. It is not the bit of plane.h, which asks a plane that was
// rounded once: where a point lies within rounding of a face's plane the two may differ, so the faces of
// one silhouette are all decided by the one or all by the other.
//
// The cross product's components are differences of products that may nearly cancel, in slivers; they are
// formed with the products' rounding errors (Dekker, A Floating-Point Technique for Extending the Available
// Precision, 1971). So collinear corners give zero wherever the differences of corners are exact.
//
// Nothing overflows and nothing is ever subnormal, whatever a device does with those: components of
// corners below 2^-100 are zero, so that differences are multiples of 2^-123; each of the three vectors
// and the cross product is multiplied by the power of two that takes its greatest component into [1, 2),
// which changes no sign, and components below 2^-40 are zero then. Products are multiples of 2^-126.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The face bit from the corners of a counter-clockwise triangle, each coordinate within
/// k_max_coordinate. Back where two corners are equal, and where the point lies in the face's plane.
bool is_front(const std::array<glm::vec3, 3>& corners, const HomogeneousPoint& point) noexcept;

/// The bits of all triangles over any positions, packed as face_bits.h says. O(triangles).
std::vector<std::uint32_t> moving_face_bits(std::span<const Triangle> triangles,
                                            std::span<const glm::vec3> positions,
                                            const HomogeneousPoint& point);

}  // namespace rimline
