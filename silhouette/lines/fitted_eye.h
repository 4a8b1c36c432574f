#pragma once

// Where a perspective camera stands so that its picture just holds all positions.
//
// In the axes of the camera each position bounds the eye on both sides of x and of y: it must lie at least
// |x - eye.x| / tangent behind the position. Both sides together give the center of the picture and the distance.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace rimline {

struct FittedEye {
    glm::dvec3 eye, target;
};

/// A picture is wider than its subject by this factor.
constexpr double k_picture_margin = 1.06;

/// The camera looks against `towards_viewer`, and the target lies in the plane through `center`. `tangents` are
/// those of half the horizontal and half the vertical field of view; the picture has a margin of 6%. `radius`
/// is that of a sphere around `center` which holds the positions; 0 counts as 1. O(positions).
FittedEye fit_eye(std::span<const glm::vec3> positions, const glm::dvec3& center, double radius,
                  const glm::dvec3& towards_viewer, const glm::dvec3& up,
                  const glm::dvec2& tangents);

}  // namespace rimline
