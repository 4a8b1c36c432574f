#pragma once

// A camera, perspective or orthographic, and the transforms that follow from it.
//
// Depth is reversed: 1 at the near plane, 0 at infinity (perspective) or behind the scene (orthographic).
// Float depth then has the same relative precision at every distance. Greater is nearer.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace rimline {

struct Camera {
    glm::dvec3 eye{0.0, 0.0, 1.0};
    glm::dvec3 target{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double fov_y_deg = 40.0;    ///< Vertical field of view of a perspective camera.
    double ortho_height = 0.0;  ///< Greater than 0: orthographic, with this picture height.

    bool is_orthographic() const noexcept { return ortho_height > 0.0; }
};

/// clip = (scale * eye.xy, z[0] * eye.z + z[1] * w, w[0] * eye.z + w[1] * w).
struct Projection {
    glm::dvec2 scale;
    glm::dvec2 z;
    glm::dvec2 w;
};

/// The rows are the camera's axes in the world: x right, y up, z towards the viewer. If `up` is parallel to
/// the view, a perpendicular axis replaces it. eye and target must differ.
glm::dmat3 camera_from_world(const Camera& camera);

/// For an orthographic camera, everything within `scene_radius` of `scene_center` lies between the near and
/// far planes, wherever the eye is. A perspective camera's near plane is at 1e-4 of that radius.
Projection make_projection(const Camera& camera, double aspect, const glm::dvec3& scene_center,
                           double scene_radius);

}  // namespace rimline
