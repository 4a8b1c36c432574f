#include "tools/view/camera_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "silhouette/mesh/ground_axes.h"

namespace rimline::tools {

namespace {

// v rotated about the unit vector `axis`, counterclockwise when seen from its tip (Rodrigues).
glm::dvec3 rotated_about(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad) {
    const double c = std::cos(angle_rad);
    return c * v + std::sin(angle_rad) * glm::cross(axis, v) + (1.0 - c) * glm::dot(axis, v) * axis;
}

// The angle of a unit vector above the horizon, in radians.
double elevation_of(const glm::dvec3& v, const glm::dvec3& up) {
    return std::asin(std::clamp(glm::dot(v, up), -1.0, 1.0));
}

// A unit vector rotated to the right and upwards. The elevation is clamped.
glm::dvec3 rotated_level(const glm::dvec3& v, const glm::dvec3& up, const glm::dvec3& right,
                         const glm::dvec2& turn_rad) {
    const double limit = glm::radians(k_max_elevation_deg);
    const double before = elevation_of(v, up);
    const double after = std::clamp(before + turn_rad.y, -limit, limit);
    // A rotation towards up is counterclockwise about v x up, which is `right`.
    const glm::dvec3 raised = rotated_about(v, right, after - before);
    return glm::normalize(rotated_about(raised, up, turn_rad.x));
}

// Perpendicular to `v` and up. If they are parallel: the right that camera_from_world() chooses.
glm::dvec3 right_of(const Camera& camera, const glm::dvec3& v) {
    const glm::dvec3 up = glm::normalize(camera.up);
    const glm::dvec3 side = glm::cross(v, up);
    if (glm::length(side) > 1e-9) return glm::normalize(side);
    const glm::dmat3 axes = glm::transpose(camera_from_world(camera));
    return axes[0];
}

}  // namespace

double view_height(const Camera& camera) {
    if (camera.is_orthographic()) return camera.ortho_height;
    return 2.0 * std::tan(0.5 * glm::radians(camera.fov_y_deg)) *
           glm::distance(camera.eye, camera.target);
}

void orbit(Camera& camera, const glm::dvec2& turn_rad) {
    const glm::dvec3 back = camera.eye - camera.target;
    const double distance = glm::length(back);
    const glm::dvec3 direction = back / distance;
    camera.eye = camera.target + distance * rotated_level(direction, glm::normalize(camera.up),
                                                          right_of(camera, direction), turn_rad);
}

void turn_about(Camera& camera, const glm::dvec3& pivot, const glm::dvec3& towards_viewer) {
    const glm::dmat3 to_axes = camera_from_world(camera);
    const glm::dvec3 eye = to_axes * (camera.eye - pivot);
    const glm::dvec3 target = to_axes * (camera.target - pivot);
    camera.eye = camera.target + towards_viewer;
    const glm::dmat3 from_axes = glm::transpose(camera_from_world(camera));
    camera.eye = pivot + from_axes * eye;
    camera.target = pivot + from_axes * target;
}

void orbit_about(Camera& camera, const glm::dvec3& pivot, const glm::dvec2& turn_rad) {
    Camera turned = camera;
    orbit(turned, turn_rad);
    turn_about(camera, pivot, turned.eye - turned.target);
}

void pan(Camera& camera, const glm::dvec2& shift) {
    const glm::dmat3 axes = glm::transpose(camera_from_world(camera));  // Columns are the axes.
    const glm::dvec3 move = -view_height(camera) * (shift.x * axes[0] + shift.y * axes[1]);
    camera.eye += move;
    camera.target += move;
}

void zoom(Camera& camera, double factor, double low, double high) {
    if (camera.is_orthographic()) {
        camera.ortho_height = std::clamp(camera.ortho_height * factor, low, high);
        return;
    }
    const glm::dvec3 back = camera.eye - camera.target;
    const double distance = glm::length(back);
    camera.eye = camera.target + back * (std::clamp(distance * factor, low, high) / distance);
}

void turn_view(Camera& camera, const glm::dvec2& turn_rad) {
    const glm::dvec3 ahead = camera.target - camera.eye;
    const double distance = glm::length(ahead);
    const glm::dvec3 direction = ahead / distance;
    // A turn to the right is clockwise when seen from above.
    camera.target = camera.eye + distance * rotated_level(direction, glm::normalize(camera.up),
                                                          right_of(camera, direction),
                                                          {-turn_rad.x, turn_rad.y});
}

void fly(Camera& camera, const glm::dvec3& step) {
    const glm::dmat3 axes = glm::transpose(camera_from_world(camera));
    const glm::dvec3 move =
        step.x * axes[0] + step.y * glm::normalize(camera.up) - step.z * axes[2];
    camera.eye += move;
    camera.target += move;
}

glm::dvec3 direction_about(const glm::dvec3& direction, const glm::dvec3& from_up,
                           const glm::dvec3& to_up) {
    const auto axes = [](const glm::dvec3& up) {
        const auto [right, away] = ground_axes(up);
        return glm::dmat3(right, away, glm::normalize(up));
    };
    return axes(to_up) * (glm::transpose(axes(from_up)) * direction);
}

void set_up(Camera& camera, const glm::dvec3& up) {
    camera.up = up;
    orbit(camera, glm::dvec2(0.0));
}

}  // namespace rimline::tools
