#pragma once

// Conversion between world coordinates and pixels of the window, for marks drawn over the picture and for
// dragging them with the mouse.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/camera.h"

namespace rimline::tools {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;  ///< Length 1, away from the viewer.
};

class ScreenView {
public:
    /// For a picture of `size` pixels. `size` may be in any other unit; pixels are then in that unit too. A camera with
    /// a projection has the aspect of that.
    ScreenView(const Camera& camera, const glm::dvec2& size);

    /// Relative to the upper left corner, y downwards. Nothing if the point is not in front of the eye.
    std::optional<glm::dvec2> pixel_of(const glm::dvec3& world) const;
    /// The ray of all points that are projected to `pixel`.
    Ray ray_through(const glm::dvec2& pixel) const;

    const Camera& camera() const noexcept { return camera_; }
    /// Length 1.
    glm::dvec3 view_direction() const;

private:
    Camera camera_;
    glm::dvec2 size_;
    glm::dmat3 axes_;  // The rows of camera_from_world() as columns.
    // Of the picture: at distance 1; with an orthographic camera, at any distance.
    glm::dvec2 half_size_;
    glm::dvec2 shift_{0.0};  // Projection::shift.
};

}  // namespace rimline::tools
