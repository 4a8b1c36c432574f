#pragma once

// Where on the screen a mesh can be, from points around it.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>

#include "engine/camera.h"
#include "engine/scene.h"

namespace rimline {

/// A box around all of an instance, in its own coordinates.
struct CasterBox {
    glm::dvec3 low, high;
};
CasterBox caster_box(const SceneInstance& instance);

/// In pixels of the picture, from its upper left corner. Empty where `low` is not below `high`.
struct ScreenBox {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};

    static ScreenBox everywhere() {
        return {glm::dvec2(-std::numeric_limits<double>::infinity()),
                glm::dvec2(std::numeric_limits<double>::infinity())};
    }
    /// The rectangle around both.
    void join(const ScreenBox& other);
};

/// The rectangle around points of an instance, in its own coordinates, and all between them, in a picture of
/// `picture_px`. `eye_from_world` is camera_from_world(). Computed as the GPU does, from a camera of floats in these
/// coordinates, and widened by the roundings on the way to the screen, without those of rasterizers. Empty if the
/// points lie behind the near plane; std::nullopt if they lie on both sides of it. O(points).
std::optional<ScreenBox> screen_box(const Camera& camera, const glm::dmat3& eye_from_world,
                                    const Projection& projection, const SceneInstance& instance,
                                    std::span<const glm::dvec3> points,
                                    const glm::dvec2& picture_px);

}  // namespace rimline
