#include "engine/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>
#include <utility>

#include "silhouette/error.h"

namespace rimline {

namespace {

// How far the product of a rotation and its transpose may be from 1: for matrices of floats it is within 1e-6.
constexpr double k_rotation_tolerance = 1e-4;

// Distance from the viewer of a perspective projection's plane of depth 0 or 1; negative or infinite for none.
double depth_plane(const Projection& projection, double depth) {
    return projection.z[1] / (depth + projection.z[0]);
}

double near_plane(const Projection& projection) {
    double near = std::numeric_limits<double>::infinity();
    for (const double depth : {0.0, 1.0}) {
        const double distance = depth_plane(projection, depth);
        if (distance > 0.0) near = std::min(near, distance);
    }
    return near;
}

// The eye.z of an orthographic projection's near plane: the nearer one of its planes of depth 0 and 1.
double orthographic_near(const Projection& projection) {
    return std::max(-projection.z[1] / projection.z[0], (1.0 - projection.z[1]) / projection.z[0]);
}

[[noreturn]] void refuse_matrix(const char* why) {
    throw Error(ErrorCode::bad_input, std::string("the projection matrix ") + why);
}

}  // namespace

glm::dmat3 camera_from_world(const Camera& camera) {
    RIMLINE_CHECK(camera.eye != camera.target);
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    glm::dvec3 right = glm::cross(camera.up, back);
    if (glm::length(right) < 1e-9 * glm::length(camera.up) || right == glm::dvec3(0.0))
        right =
            glm::cross(std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1), back);
    right = glm::normalize(right);
    return glm::transpose(glm::dmat3(right, glm::cross(back, right), back));
}

Projection make_projection(const Camera& camera, double aspect, const glm::dvec3& scene_center,
                           double scene_radius) {
    const std::optional<Projection>& given = camera.projection;
    if (!camera.is_orthographic()) {
        if (given) return {given->scale, {0.0, near_plane(*given)}, {-1.0, 0.0}, given->shift};
        const double focal = 1.0 / std::tan(0.5 * glm::radians(camera.fov_y_deg));
        return {{focal / aspect, -focal}, {0.0, 1e-4 * scene_radius}, {-1.0, 0.0}};
    }
    // Depth decreases from 1 at eye.z = near to 0 at eye.z = far.
    const double center_z =
        glm::dot(glm::normalize(camera.eye - camera.target), scene_center - camera.eye);
    double near = center_z + 1.01 * scene_radius;
    if (given) near = std::min(near, orthographic_near(*given));
    // All of the scene may lie before the near plane.
    const double far = std::min(center_z - 1.01 * scene_radius, near - scene_radius);
    const glm::dvec2 z(1.0 / (near - far), -far / (near - far));
    if (given) return {given->scale, z, {0.0, 1.0}, given->shift};
    const double scale = 2.0 / camera.ortho_height;
    return {{scale / aspect, -scale}, z, {0.0, 1.0}};
}

Projection projection_of(const glm::dmat4& matrix) {
    const auto at = [&](int row, int column) { return matrix[column][row]; };
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            if (!std::isfinite(at(row, column))) refuse_matrix("is not finite");
    for (const auto& [row, column] : {std::pair{0, 1}, {1, 0}, {2, 0}, {2, 1}, {3, 0}, {3, 1}})
        if (at(row, column) != 0.0) refuse_matrix("turns or skews the picture");
    const bool is_orthographic = at(3, 2) == 0.0;
    const double w = is_orthographic ? at(3, 3) : -at(3, 2);
    if (!(w > 0.0) || (!is_orthographic && at(3, 3) != 0.0))
        refuse_matrix("does not look along -z from the origin");
    const int plane = is_orthographic ? 3 : 2;  // The column of the shift.
    const int other = 5 - plane;
    if (at(0, other) != 0.0 || at(1, other) != 0.0) refuse_matrix("skews the picture");
    const double sign = is_orthographic ? 1.0 : -1.0;
    const Projection projection{.scale = {at(0, 0) / w, at(1, 1) / w},
                                .z = {at(2, 2) / w, at(2, 3) / w},
                                .w = is_orthographic ? glm::dvec2(0.0, 1.0) : glm::dvec2(-1.0, 0.0),
                                .shift = {sign * at(0, plane) / w, sign * at(1, plane) / w}};
    if (!(projection.scale.x > 0.0 && projection.scale.y < 0.0))
        refuse_matrix("mirrors the picture: x must go right and y down");
    if (is_orthographic ? projection.z[0] == 0.0 : !std::isfinite(near_plane(projection)))
        refuse_matrix("has no near plane before the viewer");
    return projection;
}

bool is_rotation(const glm::dmat3& matrix) noexcept {
    const glm::dmat3 error = matrix * glm::transpose(matrix) - glm::dmat3(1.0);
    for (int column = 0; column < 3; ++column)
        if (!(glm::length(error[column]) <= k_rotation_tolerance)) return false;
    return glm::determinant(matrix) > 0.0;
}

Camera camera_of(const glm::dmat4& view, const glm::dmat4& projection) {
    const glm::dmat3 rotation(view);
    if (!is_rotation(rotation) || view[0][3] != 0.0 || view[1][3] != 0.0 || view[2][3] != 0.0 ||
        view[3][3] != 1.0)
        throw Error(ErrorCode::bad_input, "the view matrix is not a rotation and a translation");
    const glm::dmat3 axes = glm::transpose(rotation);
    Camera camera{.eye = -(axes * glm::dvec3(view[3])), .up = axes[1]};
    camera.target = camera.eye - axes[2];
    camera.projection = projection_of(projection);
    return camera;
}

}  // namespace rimline
