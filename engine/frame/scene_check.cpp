#include "engine/frame/scene_check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/camera.h"
#include "engine/picture_lines.h"
#include "engine/renderer_options.h"
#include "engine/scene.h"
#include "engine/vulkan/device_context.h"
#include "engine/vulkan/picture_target.h"
#include "silhouette/error.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

namespace {

bool is_place(const glm::dvec3& p) { return HomogeneousPoint::is_valid(glm::vec3(p)); }

// All components are finite.
bool is_finite(const glm::dvec4& v) { return std::isfinite(glm::dot(v, glm::dvec4(1.0))); }
bool is_color(const glm::vec3& color) { return is_finite({color, 0.0}); }

bool is_share(float value) { return value >= 0.0f && value <= 1.0f; }

bool is_length(double value) { return value >= 0.0 && std::isfinite(value); }

void check_camera(const Camera& camera) noexcept {
    RIMLINE_CHECK(is_place(camera.eye) && is_place(camera.target));
    RIMLINE_CHECK(camera.eye != camera.target);
    RIMLINE_CHECK(std::isfinite(glm::dot(camera.up, camera.up)));
    RIMLINE_CHECK(is_length(camera.ortho_height));
    if (const std::optional<Projection>& given = camera.projection) {
        RIMLINE_CHECK(is_finite({given->scale, given->shift}) && is_finite({given->z, given->w}));
        RIMLINE_CHECK(given->scale.x != 0.0 && given->scale.y != 0.0);
    }
    const bool has_angle = !camera.projection && !camera.is_orthographic();
    RIMLINE_CHECK(!has_angle || (camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0));
}

void check_material(const Material& material) noexcept {
    RIMLINE_CHECK(is_color(material.color));
    RIMLINE_CHECK(!material.line_color || is_color(*material.line_color));
}

void check_lines(const PictureLines& lines) noexcept {
    for (const PictureLine& line : lines.lines)
        RIMLINE_CHECK(line.color == k_own_line_color || line.color < lines.colors.size());
    for (const glm::vec3& color : lines.colors) RIMLINE_CHECK(is_color(color));
}

void check_deformation(const Deformation& deformation) noexcept {
    if (const auto* wave = std::get_if<Wave>(&deformation)) {
        RIMLINE_CHECK(is_place(wave->center) && is_place(wave->direction));
        RIMLINE_CHECK(is_place(wave->travel));
        RIMLINE_CHECK(std::isfinite(wave->amplitude) && std::isfinite(wave->turns));
        RIMLINE_CHECK(is_length(wave->length) && wave->length > 0.0);
    } else {
        const auto& moved = std::get<MovedPositions>(deformation);
        RIMLINE_CHECK(is_place(moved.center) && is_length(moved.radius));
    }
}

void check_instance(const SceneInstance& instance) noexcept {
    RIMLINE_CHECK(instance.deforming != nullptr || instance.octree != nullptr);
    RIMLINE_CHECK(is_rotation(instance.rotation));
    RIMLINE_CHECK(is_place(instance.translation));
    RIMLINE_CHECK(instance.scale > 0.0 && std::isfinite(instance.scale));
    check_material(instance.material);
    if (instance.deforming != nullptr) check_deformation(instance.deformation);
    if (instance.picture_lines != nullptr) check_lines(*instance.picture_lines);
    RIMLINE_CHECK(is_length(instance.fade_radius) && is_place(instance.fade_center));
}

void check_light(const Light& light) noexcept {
    RIMLINE_CHECK(is_place(light.vector));
    RIMLINE_CHECK(!light.directional || glm::length(light.vector) > 0.0);
    RIMLINE_CHECK(!light.share || (*light.share > 0.0f && std::isfinite(*light.share)));
    RIMLINE_CHECK(!light.fills || (!light.casts_shadows && light.share.value_or(1.0f) <= 1.0f));
}

}  // namespace

void check_scene(const Scene& scene) noexcept {
    check_camera(scene.camera);
    if (scene.silhouette_camera) check_camera(*scene.silhouette_camera);
    for (const SceneInstance& instance : scene.instances) check_instance(instance);
    for (const Light& light : scene.lights) check_light(light);
    RIMLINE_CHECK(std::ranges::is_sorted(scene.lights, {}, &Light::fills));
    const Palette& palette = scene.palette;
    RIMLINE_CHECK(is_color(palette.background) && is_color(palette.ink));
    RIMLINE_CHECK(is_color(palette.shade) && is_color(palette.grid));
    RIMLINE_CHECK(is_share(palette.grid_strength) && is_share(scene.hidden_line_strength));
    RIMLINE_CHECK(is_length(scene.line_width_px));
    RIMLINE_CHECK(is_length(scene.dash_px) && is_length(scene.dash_gap_px));
    RIMLINE_CHECK(is_length(scene.crease_angle_deg));
    RIMLINE_CHECK(is_length(scene.hatch_spacing_px) && scene.hatch_spacing_px > 0.0f);
}

void check_target(const PictureTarget& target) noexcept {
    RIMLINE_CHECK(target.image != VK_NULL_HANDLE && target.view != VK_NULL_HANDLE);
    RIMLINE_CHECK(target.corner.x >= 0 && target.corner.y >= 0);
    RIMLINE_CHECK(!target.condition || (target.condition->buffer != VK_NULL_HANDLE &&
                                        target.condition->offset % 4 == 0));
    if (!target.backdrop) return;
    RIMLINE_CHECK(target.backdrop->image != VK_NULL_HANDLE);
    RIMLINE_CHECK(target.backdrop->view != VK_NULL_HANDLE);
    RIMLINE_CHECK(depth_aspects(target.backdrop->format) != 0);
}

const DeviceContext& checked(const DeviceContext& context) noexcept {
    RIMLINE_CHECK(context.vk != nullptr && context.device != VK_NULL_HANDLE);
    RIMLINE_CHECK(context.queue != VK_NULL_HANDLE);
    return context;
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
