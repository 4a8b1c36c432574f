#pragma once

// The motion of an animation: the camera moves along points, the lights turn around the model or move with
// the camera, and the model may deform. Computes the scene of each frame from the scene of the first.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "engine/scene.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// Width of a picture that shows a whole model, in diameters of the model's bounding sphere.
constexpr double k_view_margin = 1.06;

enum class LightMotion {
    still,
    turning,      ///< Around the model's center, about the camera's up axis.
    with_camera,  ///< Fixed relative to the camera.
};

struct Motion {
    /// The eye in each frame. Empty: the camera does not move. For a direction (w = 0) the eye is at
    /// `distance` from the target.
    std::vector<HomogeneousPoint> eyes;
    double distance = 1.0;
    std::vector<glm::dvec3> ups;  ///< The up axis in each frame. Empty: that of the first camera.
    LightMotion lights = LightMotion::still;
    double light_step_degrees = 0.0;  ///< Rotation of turning lights per frame.
    /// The direction of the last light, a sun, in each frame. Empty: it moves as the others.
    std::vector<glm::dvec3> suns;
    bool has_fill_and_rim =
        false;  ///< The last two lights are those of three_point.h, and the sun lies before them.
    /// Deforms the first instance. It travels `wave_turns` wavelengths per frame, from its state in frame 0.
    std::optional<Wave> wave;
    double wave_turns = 0.0;
};

/// Camera and lights of a frame.
struct Shot {
    Camera camera;
    std::vector<Light> lights;
};

class Animation {
public:
    /// `first` is the scene of frame 0 without motion. Its first instance shows `mesh`, which must outlive
    /// the animation.
    Animation(Scene first, const Mesh& mesh, Motion motion);

    /// The scene of a frame, valid until the next call, which may be given lines. Call it in order of frames: if the eye is at the
    /// target, the camera keeps the view direction of the frame before. Throws Error{too_large} if a camera
    /// or a light leaves the range of coordinates.
    Scene& at(std::uint32_t frame);

private:
    void place_camera(std::uint32_t frame);
    void place_lights(std::uint32_t frame);
    void move_lights(std::uint32_t frame);

    Scene scene_;
    const Mesh& mesh_;
    Motion motion_;
    Camera first_camera_;
    std::vector<Light> first_lights_;
    glm::dvec3 back_;  // From the target to the eye, of length 1.
};

/// Of every `stride`-th of the first `count` frames. `first` needs no instances. Throws as Animation::at().
std::vector<Shot> shots_of(const Scene& first, const Mesh& mesh, Motion motion, std::uint32_t count,
                           std::uint32_t stride = 1);

}  // namespace rimline::tools
