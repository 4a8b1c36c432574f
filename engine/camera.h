#pragma once

// A camera, perspective or orthographic, and the transforms that follow from it.
//
// Depth is reversed: 1 at the near plane, 0 at infinity (perspective) or behind the scene (orthographic).
// Float depth then has the same relative precision at every distance. Greater is nearer.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace rimline {

/// clip = (scale * eye.xy + shift * clip.w, z[0] * eye.z + z[1] * w, w[0] * eye.z + w[1] * w).
struct Projection {
    glm::dvec2 scale;
    glm::dvec2 z;
    glm::dvec2 w;
    /// Of the picture, in halves of its width and height, right and down: an off-axis view, or jitter. A pixel
    /// is 2 / width.
    glm::dvec2 shift{0.0};

    bool is_orthographic() const noexcept { return w[0] == 0.0; }
    bool operator==(const Projection&) const = default;
};

struct Camera {
    glm::dvec3 eye{0.0, 0.0, 1.0};
    glm::dvec3 target{0.0};  ///< Not the eye.
    glm::dvec3 up{0.0, 1.0, 0.0};
    double fov_y_deg =
        40.0;  ///< Vertical field of view of a perspective camera: between 0 and 180.
    double ortho_height = 0.0;  ///< Greater than 0: orthographic, with this picture height.

    /// Instead of fov_y_deg and ortho_height: the projection of another renderer (projection_of()), of any depth
    /// convention. What lies before its near plane is clipped, and nothing at its far plane.
    std::optional<Projection> projection;

    bool is_orthographic() const noexcept {
        return projection ? projection->is_orthographic() : ortho_height > 0.0;
    }
    bool operator==(const Camera&) const = default;
};

/// The projection that a matrix describes, for Vulkan's clip space: y down, depth from 0 to 1 or from 1 to 0,
/// the viewer at the origin and looking along -z, in right-handed coordinates. The far plane may be at infinity. A
/// renderer with y up, which has a viewport of negative height, negates the matrix's second row first. Throws
/// Error{bad_input} for a matrix that mirrors, turns or skews the picture, or that has no near plane before the
/// viewer.
Projection projection_of(const glm::dmat4& matrix);

/// Whether a matrix is a rotation, as near as floats give it: orthonormal within 1e-4, without reflection.
bool is_rotation(const glm::dmat3& matrix) noexcept;

/// The camera of a view matrix (from the world into the camera's axes, a rotation and a translation) and a
/// matrix that projection_of() takes. Throws as that, and Error{bad_input} where `view` is something else.
Camera camera_of(const glm::dmat4& view, const glm::dmat4& projection);

/// The rows are the camera's axes in the world: x right, y up, z towards the viewer. If `up` is parallel to
/// the view, a perpendicular axis replaces it. eye and target must differ.
glm::dmat3 camera_from_world(const Camera& camera);

/// For an orthographic camera, everything within `scene_radius` of `scene_center` lies between the near and
/// far planes, wherever the eye is. A perspective camera's near plane is at 1e-4 of that radius, or where
/// camera.projection has it. `aspect` does not count where the camera has a projection.
Projection make_projection(const Camera& camera, double aspect, const glm::dvec3& scene_center,
                           double scene_radius);

}  // namespace rimline
