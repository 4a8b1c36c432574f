#pragma once

// How a hand moves a camera: around its target, along the picture, nearer, or flying freely. All of it
// is arithmetic on a Camera, without a window.
//
// The horizon stays level: turning is around the up axis and over the top, and stops short of the poles,
// where up would mean nothing.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/camera.h"

namespace rimline::tools {

/// No view is steeper than this against the horizon.
constexpr double k_max_elevation_deg = 89.0;

/// Turns the eye around the target: x to the right around the up axis, y upwards. In radians.
void orbit(Camera& camera, const glm::dvec2& turn_rad);

/// Moves eye and target so that what lies as far away as the target moves by `shift` on the screen: to
/// the right and upwards, in heights of the picture.
void pan(Camera& camera, const glm::dvec2& shift);

/// Brings the target nearer (factor below 1) or farther; orthographic views grow and shrink instead.
/// The distance, or the height, stays within [least, most].
void zoom(Camera& camera, double factor, double least, double most);

/// Turns the view around the eye: x to the right, y upwards. In radians.
void look_around(Camera& camera, const glm::dvec2& turn_rad);

/// Moves eye and target by `step` along the view's right, the up axis, and the view itself. An
/// orthographic camera moves as well, though moving along its view shows nothing.
void fly(Camera& camera, const glm::dvec3& step);

/// Changes what is up, keeping eye and target. Where the view is too steep then, it is tilted.
void set_up(Camera& camera, const glm::dvec3& up);

/// How high the picture is at the target, in the units of the world.
double view_height(const Camera& camera);

}  // namespace rimline::tools
