#pragma once

// Between the world and the pixels of a window, for what is drawn over the picture and taken by hand.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/camera.h"

namespace rimline::tools {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;  ///< Of length 1, away from the viewer.
};

class ScreenView {
public:
    /// Of a picture of `size` pixels, or of any other unit that pixels are counted in.
    ScreenView(const Camera& camera, const glm::dvec2& size);

    /// From the upper left corner, y downwards. Nothing for what is not in front of the eye.
    std::optional<glm::dvec2> pixel_of(const glm::dvec3& world) const;
    /// What is seen at a pixel lies on it.
    Ray ray_through(const glm::dvec2& pixel) const;

    const Camera& camera() const noexcept { return camera_; }
    /// Of length 1.
    glm::dvec3 view_direction() const;

private:
    Camera camera_;
    glm::dvec2 size_;
    glm::dmat3 axes_;       // The rows of camera_from_world() as columns.
    glm::dvec2 half_size_;  // Of the picture, at distance 1 or, orthographic, anywhere.
};

}  // namespace rimline::tools
