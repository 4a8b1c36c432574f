#pragma once

// Camera control by mouse and keys: orbit, pan, zoom, turning the view, flying. Pure arithmetic on a Camera,
// without a window.
//
// The horizon stays level. Turning changes the azimuth around the up axis and the elevation above the
// horizon; the elevation stops short of the poles, where up is undefined.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/camera.h"

namespace rimline::tools {

/// Limit of the elevation of the view, up and down.
constexpr double k_max_elevation_deg = 89.0;

/// Turns the eye around the target: x to the right around the up axis, y upwards, in radians.
void orbit(Camera& camera, const glm::dvec2& turn_rad);

/// The same, but all of the camera turns around `pivot`, which keeps its place in the picture.
void orbit_about(Camera& camera, const glm::dvec3& pivot, const glm::dvec2& turn_rad);

/// The same, until the eye is in this direction from the target (not zero, not along up).
void turn_about(Camera& camera, const glm::dvec3& pivot, const glm::dvec3& towards_viewer);

/// Translates eye and target so that points at the target's distance move by `shift` on the screen: x to the
/// right, y upwards, in heights of the picture.
void pan(Camera& camera, const glm::dvec2& shift);

/// Multiplies the distance from target to eye by `factor`; of an orthographic camera, the height of the
/// view. The result is clamped to [low, high].
void zoom(Camera& camera, double factor, double low, double high);

/// Turns the view around the eye: x to the right, y upwards, in radians.
void turn_view(Camera& camera, const glm::dvec2& turn_rad);

/// Translates eye and target by `step`: x along the view's right, y along the up axis, z along the view.
/// With an orthographic camera, z changes nothing in the picture.
void fly(Camera& camera, const glm::dvec3& step);

/// The direction that has the azimuth and the elevation of `direction`, about `from_up`, about `to_up` (ground_axes.h).
glm::dvec3 direction_about(const glm::dvec3& direction, const glm::dvec3& from_up,
                           const glm::dvec3& to_up);

/// Sets the up axis and keeps eye and target. Tilts the view if it exceeds the maximum elevation.
void set_up(Camera& camera, const glm::dvec3& up);

/// Height of the picture at the target, in world units.
double view_height(const Camera& camera);

}  // namespace rimline::tools
