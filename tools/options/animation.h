#pragma once

// What moves in an animation: the camera along points, the lights around the model or with the camera,
// and the model itself. From the scene of the first frame follows that of any other.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "engine/scene.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// Width of a picture that shows all of a model, in widths of the model's bounding sphere.
constexpr double k_view_margin = 1.06;

enum class LightMotion {
    still,
    turning,      ///< Around the model, about the camera's up axis.
    with_camera,  ///< As if they were fastened to it.
};

struct Motion {
    /// Where the camera stands in each frame; empty: where it stands in the first. From a direction
    /// (w = 0) it looks from `distance` away.
    std::vector<HomogeneousPoint> eyes;
    double distance = 1.0;
    std::vector<glm::dvec3> ups;  ///< What is up in each frame; empty: what is in the first.
    LightMotion lights = LightMotion::still;
    double light_step_degrees = 0.0;  ///< Of turning lights, a frame.
    /// Of the first instance, a wave, at rest before the first frame; and how many lengths it runs a frame.
    std::optional<Wave> wave;
    double wave_turns = 0.0;
};

class Animation {
public:
    /// `first` has the camera and the lights as frame 0 would without motion; its first instance shows
    /// `mesh`, which must outlive the animation.
    Animation(Scene first, const Mesh& mesh, Motion motion);

    /// The scene of a frame. Frames are asked for in order: where the camera's eye is what it looks at, it
    /// keeps the way it looked before. Throws Error{too_large} where a camera or a light leaves the range
    /// of coordinates.
    const Scene& at(std::uint32_t frame);

private:
    void place_camera(std::uint32_t frame);
    void place_lights(std::uint32_t frame);

    Scene scene_;
    const Mesh& mesh_;
    Motion motion_;
    Camera first_camera_;
    std::vector<Light> first_lights_;
    glm::dvec3 back_;  // From what the camera looks at towards it, of length 1.
};

}  // namespace rimline::tools
