#pragma once

// The face bit of a triangle whose corners move. It is computed from the corners, because planes would
// change every frame.
//
//     front(v0, v1, v2, p)  :=  ((v1 - v0) x (v2 - v0)) · (p - w*v0)  >  0
//
// In float32, in a fixed order, without FMA. shaders/moving_face.glsl has the same expression, and both
// give the same bit for all corners and points. The bit of plane.h uses a plane that was rounded once. The
// two bits may differ if a point is within rounding error of a face's plane. Use only one of them for all
// faces of one silhouette.
//
// The components of the cross product are differences of products. In slivers these nearly cancel, so the
// products' rounding errors are added (Dekker, A Floating-Point Technique for Extending the Available
// Precision, 1971). Collinear corners give zero if the differences of corners are exact.
//
// No value overflows or is subnormal, so results do not depend on how a device treats subnormals.
// Components of corners below 2^-100 are set to 0, so differences are multiples of 2^-123. Each of the
// three vectors and the cross product is scaled by the power of two that brings its largest component into
// [1, 2), which changes no sign. Components below 2^-40 are then set to 0. Products are multiples of
// 2^-126.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The face bit from the corners of a counter-clockwise triangle, with each coordinate within
/// k_max_coordinate. Back if two corners are equal or the point lies in the face's plane.
bool is_front(const std::array<glm::vec3, 3>& corners, const HomogeneousPoint& point) noexcept;

/// The bits of all triangles for the given positions, packed as in face_bits.h. O(triangles).
std::vector<std::uint32_t> moving_face_bits(std::span<const Triangle> triangles,
                                            std::span<const glm::vec3> positions,
                                            const HomogeneousPoint& point);

}  // namespace rimline
