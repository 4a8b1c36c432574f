#include "engine/frame/scene_check.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/camera.h"
#include "engine/renderer_options.h"
#include "engine/scene.h"
#include "silhouette/error.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

namespace {

bool is_place(const glm::dvec3& p) { return HomogeneousPoint::is_valid(glm::vec3(p)); }

bool is_share(float value) { return value >= 0.0f && value <= 1.0f; }

bool is_length(double value) { return value >= 0.0 && std::isfinite(value); }

void check_camera(const Camera& camera) noexcept {
    RIMLINE_CHECK(is_place(camera.eye) && is_place(camera.target));
    RIMLINE_CHECK(camera.eye != camera.target);
    RIMLINE_CHECK(std::isfinite(glm::dot(camera.up, camera.up)));
    RIMLINE_CHECK(is_length(camera.ortho_height));
    const bool has_angle = !camera.projection && !camera.is_orthographic();
    RIMLINE_CHECK(!has_angle || (camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0));
}

void check_instance(const SceneInstance& instance) noexcept {
    RIMLINE_CHECK(instance.deforming != nullptr || instance.octree != nullptr);
    RIMLINE_CHECK(is_rotation(instance.rotation));
    RIMLINE_CHECK(is_place(instance.translation));
    RIMLINE_CHECK(is_length(instance.fade_radius) && is_place(instance.fade_center));
}

void check_light(const Light& light) noexcept {
    RIMLINE_CHECK(is_place(light.vector));
    RIMLINE_CHECK(!light.directional || glm::length(light.vector) > 0.0);
    RIMLINE_CHECK(!light.share || (*light.share > 0.0f && std::isfinite(*light.share)));
}

}  // namespace

void check_scene(const Scene& scene) noexcept {
    check_camera(scene.camera);
    if (scene.silhouette_camera) check_camera(*scene.silhouette_camera);
    for (const SceneInstance& instance : scene.instances) check_instance(instance);
    for (const Light& light : scene.lights) check_light(light);
    RIMLINE_CHECK(is_share(scene.palette.grid_strength) && is_share(scene.hidden_line_strength));
    RIMLINE_CHECK(is_length(scene.line_width_px));
    RIMLINE_CHECK(is_length(scene.dash_px) && is_length(scene.dash_gap_px));
    RIMLINE_CHECK(is_length(scene.crease_angle_deg));
    RIMLINE_CHECK(is_length(scene.hatch_spacing_px) && scene.hatch_spacing_px > 0.0f);
}

const RendererOptions& checked(const RendererOptions& options) noexcept {
    RIMLINE_CHECK(options.frames_in_flight > 0);
    RIMLINE_CHECK(options.crease_angle_rad >= 0.0f);
    RIMLINE_CHECK(options.outline.depth_step >= 0.0f);
    RIMLINE_CHECK(options.outline.normal_step_deg >= 0.0f &&
                  options.outline.normal_step_deg <= 180.0f);
    return options;
}

}  // namespace rimline
