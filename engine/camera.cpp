#include "engine/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "silhouette/error.h"

namespace rimline {

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
    if (!camera.is_orthographic()) {
        const double focal = 1.0 / std::tan(0.5 * glm::radians(camera.fov_y_deg));
        return {{focal / aspect, -focal}, {0.0, 1e-4 * scene_radius}, {-1.0, 0.0}};
    }
    const double scale = 2.0 / camera.ortho_height;
    // Depth decreases from 1 at eye.z = near to 0 at eye.z = far.
    const double center_z =
        glm::dot(glm::normalize(camera.eye - camera.target), scene_center - camera.eye);
    const double near = center_z + 1.01 * scene_radius;
    const double far = center_z - 1.01 * scene_radius;
    return {{scale / aspect, -scale}, {1.0 / (near - far), -far / (near - far)}, {0.0, 1.0}};
}

}  // namespace rimline
