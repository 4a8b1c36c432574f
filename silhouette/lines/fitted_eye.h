#pragma once

// Where a perspective camera stands, or what it shows from where it stands, so that its picture just holds all
// positions.
//
// fit_eye: in the axes of the camera each position bounds the eye on both sides of x and of y: it must lie at least
// |x - eye.x| / tangent behind the position. Both sides together give the center of the picture and the distance.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
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

struct FittedLens {
    glm::dvec3 target;
    glm::dvec3 up;   ///< Turned where the view is along it, so that the picture does not rotate.
    double tangent;  ///< Of half the vertical field of view.
};

/// Turns a camera that stays at `eye`, and chooses its field of view so that the picture, `aspect` times as wide as
/// high, holds all positions with a margin of 6%, in its middle. Returns nothing if there is no position, or if one
/// lies behind the eye or more than 80 degrees aside: then no picture can hold all. `up` must not be zero.
/// O(positions).
std::optional<FittedLens> fit_lens(std::span<const glm::vec3> positions, const glm::dvec3& center,
                                   const glm::dvec3& eye, const glm::dvec3& up, double aspect);

}  // namespace rimline
