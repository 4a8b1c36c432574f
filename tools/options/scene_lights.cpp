#include "tools/options/scene_lights.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/renderer_options.h"
#include "engine/view_defaults.h"
#include "tools/options/picture_scene.h"
#include "tools/options/view_camera.h"

namespace rimline::tools {

PictureFrame picture_frame(const Camera& camera, double aspect) {
    const glm::dmat3 axes = camera_from_world(camera);
    const double half_height = camera.is_orthographic()
                                   ? 0.5 * camera.ortho_height
                                   : std::tan(0.5 * glm::radians(camera.fov_y_deg));
    return {.eye = camera.eye,
            .right = {axes[0][0], axes[1][0], axes[2][0]},
            .up = {axes[0][1], axes[1][1], axes[2][1]},
            .back = {axes[0][2], axes[1][2], axes[2][2]},
            .half_size = {half_height * aspect, half_height},
            .is_orthographic = camera.is_orthographic()};
}

SceneLights::SceneLights(const PictureOptions& options, const Mesh& mesh, bool has_ground,
                         const LongCall& call)
    : options_{.up = ground_up_of(mesh, options), .has_ground = has_ground} {
    for (const glm::vec3& light : options.lights)
        given_.push_back({.vector = glm::dvec3(light), .directional = false});
    for (const glm::vec3& sun : options.suns)
        given_.push_back({.vector = glm::dvec3(sun), .directional = true});
    if (options.has_chosen_sun || given_.empty())
        survey_.emplace(mesh, RendererOptions{}.crease_angle_rad, call);
}

std::vector<Light> SceneLights::lights(const Camera& camera, double aspect,
                                       const LongCall& call) const {
    std::vector<Light> lights = given_;
    if (!survey_) return lights;
    const std::optional<PictureSun> sun =
        choose_picture_sun(*survey_, picture_frame(camera, aspect), options_, call);
    const glm::dvec3 direction = sun ? sun->direction : default_sun(camera).vector;
    lights.push_back({.vector = rounded_to_float(direction), .directional = true});
    return lights;
}

std::vector<glm::dvec3> SceneLights::moving_sun(std::span<const Shot> shots, double aspect,
                                                const LongCall& call) const {
    std::vector<PictureFrame> frames;
    for (const Shot& shot : shots) frames.push_back(picture_frame(shot.camera, aspect));
    return choose_moving_sun(*survey_, frames, options_, call);
}

}  // namespace rimline::tools
