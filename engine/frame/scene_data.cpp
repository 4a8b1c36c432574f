#include "engine/frame/scene_data.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>

namespace rimline {

namespace {

static_assert(static_cast<int>(Style::ink) == RIMLINE_STYLE_INK &&
              static_cast<int>(Style::toon) == RIMLINE_STYLE_TOON &&
              static_cast<int>(Style::mask) == RIMLINE_STYLE_MASK &&
              static_cast<int>(Style::blueprint) == RIMLINE_STYLE_BLUEPRINT &&
              static_cast<int>(Style::hatch) == RIMLINE_STYLE_HATCH);

constexpr double k_finite_extrusion_radii = 8.0;

// How far behind its surface a line may lie, of its distance from the viewer or of the scene's depth.
// Lines and surfaces have their depths from the same vertices and the same expressions; interpolating
// them rounds by some 1e-7, and continuing a surface to a line's spine (line.frag) multiplies that by a
// few: a hundred times that much keeps lines whole on their own surface. It is safe, for what it shows
// wrongly lies behind by a hundred-thousandth of its distance: a seventieth of a pixel's width at a field
// of view of 40 degrees and 1000 pixels.
constexpr float k_depth_slack = 1e-5f;

// How far from the middle of a line line.frag looks for what hides it (4 pixels), and as much again.
constexpr double k_look_reach_px = 8.0;
// Of a vector that a float matrix turns: each product and sum rounds by half of 2^-23, and some more.
constexpr double k_float_rounding = 4e-7;

struct ScreenBox {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

// Points of the world in an instance's own coordinates.
glm::dvec3 point_in_object(const SceneInstance& instance, const glm::dvec3& world) {
    return glm::transpose(instance.rotation) * (world - instance.translation);
}
glm::dvec3 direction_in_object(const SceneInstance& instance, const glm::dvec3& world) {
    return glm::transpose(instance.rotation) * world;
}

// Where a box is on the screen, in pixels, which is nowhere for what lies behind the near plane; nothing
// for what lies on both sides of it. As the GPU computes it: from a camera of floats in the box's own
// coordinates, and with what rounds on the way.
std::optional<ScreenBox> screen_box(const Scene& scene, const SceneInstance& instance,
                                    const Projection& projection, const glm::dvec2& picture) {
    const CasterBox box = caster_box(instance);
    const glm::dvec3 camera(glm::vec3(point_in_object(instance, scene.camera.eye)));
    const glm::dmat3 eye_from_object(
        glm::mat3(camera_from_world(scene.camera) * instance.rotation));
    const double near = scene.camera.is_orthographic() ? 0.0 : projection.z[1];
    ScreenBox found;
    bool is_before = false;
    bool is_behind = false;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1u) != 0 ? box.high.x : box.low.x,
                               (corner & 2u) != 0 ? box.high.y : box.low.y,
                               (corner & 4u) != 0 ? box.high.z : box.low.z);
        const glm::dvec3 eye = eye_from_object * (point - camera);
        const double w = projection.w[0] * eye.z + projection.w[1];
        const double rounding = k_float_rounding * glm::length(point - camera);
        const double w_rounding = std::abs(projection.w[0]) * rounding;
        if (w + w_rounding <= near) {
            is_behind = true;
            continue;
        }
        if (!(w - w_rounding > near)) return std::nullopt;
        is_before = true;
        const glm::dvec2 ndc = projection.scale * glm::dvec2(eye) / w;
        const glm::dvec2 off =
            (glm::abs(projection.scale) * rounding + glm::abs(ndc) * w_rounding) / w;
        found.low = glm::min(found.low, (0.5 * (ndc - off) + 0.5) * picture);
        found.high = glm::max(found.high, (0.5 * (ndc + off) + 0.5) * picture);
    }
    if (is_before && is_behind) return std::nullopt;
    return found;
}

// Where in a pixel the first of its samples lies (Vulkan's standard sample locations).
glm::vec2 first_sample_place(std::uint32_t samples) {
    if (samples == 4) return {0.375f, 0.125f};
    return samples == 2 ? glm::vec2(0.75f, 0.75f) : glm::vec2(0.5f, 0.5f);
}

}  // namespace

HomogeneousPoint camera_point(const SceneInstance& instance, const Camera& camera) {
    if (!camera.is_orthographic())
        return HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, camera.eye)));
    return HomogeneousPoint::direction(
        glm::vec3(direction_in_object(instance, glm::normalize(camera.eye - camera.target))));
}

const Camera& lines_camera(const Scene& scene) {
    return scene.silhouette_camera ? *scene.silhouette_camera : scene.camera;
}

HomogeneousPoint light_point(const SceneInstance& instance, const Light& light) {
    if (!light.directional)
        return HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, light.vector)));
    return HomogeneousPoint::direction(
        glm::vec3(direction_in_object(instance, glm::normalize(light.vector))));
}

float finite_extrusion(const Light& light, const SceneInstance& instance,
                       const SceneBounds& bounds) {
    if (light.directional) return float(k_finite_extrusion_radii * bounds.radius);
    const BoundingSphere sphere = instance.bounds();
    const glm::dvec3 middle = instance.rotation * sphere.center + instance.translation;
    const double begin = glm::distance(light.vector, middle) - sphere.radius;
    const double end = glm::distance(light.vector, bounds.center) + 1.01 * bounds.radius;
    if (begin * k_max_extrusion_times <= end) return float(k_max_extrusion_times);
    return float(end / begin);
}

ShadowView shadow_view(const Scene& scene, const SceneInstance& instance,
                       const Projection& projection) {
    const glm::dvec3 back = glm::normalize(scene.camera.eye - scene.camera.target);
    ShadowView view{.orthographic = scene.camera.is_orthographic(),
                    // As instance_data() has it.
                    .eye = glm::dvec3(glm::vec3(point_in_object(instance, scene.camera.eye))),
                    .back = direction_in_object(instance, back)};
    if (!view.orthographic) {
        // The near plane is where clip.z is clip.w; at its corners clip.x and clip.y are too.
        const double near = projection.z[1];
        view.near_reach =
            near * glm::length(glm::dvec3(1.0 / projection.scale.x, 1.0 / projection.scale.y, 1.0));
    } else {
        // Depth ends at -z[1] / z[0] along the view.
        view.far = glm::dot(view.back, view.eye) - projection.z[1] / projection.z[0];
    }
    return view;
}

CasterBox caster_box(const SceneInstance& instance) {
    if (!instance.deforming)
        return {glm::dvec3(instance.mesh().bounds().low),
                glm::dvec3(instance.mesh().bounds().high)};
    const BoundingSphere sphere = instance.bounds();
    return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

VkRect2D drawn_rect(const Scene& scene, VkExtent2D size) {
    const SceneBounds bounds = bounds_of(scene);
    const Projection projection = make_projection(scene.camera, double(size.width) / size.height,
                                                  bounds.center, bounds.radius);
    const glm::dvec2 picture(size.width, size.height);
    const double reach = k_look_reach_px + 0.5 * std::max(0.0, double(scene.line_width_px));
    ScreenBox all;
    for (const SceneInstance& instance : scene.instances) {
        const std::optional<ScreenBox> box = screen_box(scene, instance, projection, picture);
        if (!box) return {{0, 0}, size};
        const glm::dvec2 low = box->low - reach;
        const glm::dvec2 high = box->high + reach;
        const bool is_seen = high.x > 0.0 && high.y > 0.0 && low.x < picture.x && low.y < picture.y;
        if (!is_seen) continue;
        all.low = glm::min(all.low, low);
        all.high = glm::max(all.high, high);
    }
    if (!(all.low.x < all.high.x)) return {{0, 0}, {1, 1}};
    const glm::dvec2 low = glm::floor(glm::max(all.low, 0.0));
    const glm::dvec2 high = glm::ceil(glm::min(all.high, picture));
    return {
        {static_cast<std::int32_t>(low.x), static_cast<std::int32_t>(low.y)},
        {static_cast<std::uint32_t>(high.x - low.x), static_cast<std::uint32_t>(high.y - low.y)}};
}

bool has_lines(const Scene& scene, const SceneInstance& instance) {
    return scene.lines && instance.has_lines;
}
bool casts_shadows(const Scene& scene, const SceneInstance& instance) {
    return scene.shadows && instance.casts_shadows;
}

const glm::vec3& line_color(const Scene& scene, const SceneInstance& instance) {
    return instance.material.line_color ? *instance.material.line_color : scene.palette.ink;
}

HomogeneousPoint casting_point(const Scene& scene, const SceneInstance& instance,
                               const Light& light) {
    const HomogeneousPoint point = light_point(instance, light);
    if (!casts_shadows(scene, instance) || !instance.octree) return point;
    return light_off_vertices(instance.octree->mesh(), point);
}

std::uint32_t crease_count(const Scene& scene, const GpuMesh& mesh) {
    if (scene.crease_angle_deg <= 0.0f) return 0;
    return mesh.crease_count(glm::radians(scene.crease_angle_deg));
}

gpu::FrameData frame_data(const Scene& scene, const RenderTargets& targets) {
    const VkExtent2D extent = targets.pass_extent();
    const SceneBounds bounds = bounds_of(scene);
    const Projection projection = make_projection(
        scene.camera, double(extent.width) / extent.height, bounds.center, bounds.radius);
    const bool orthographic = scene.camera.is_orthographic();
    return {.clip_scale = glm::vec2(projection.scale) / targets.guard(),
            .clip_z = glm::vec2(projection.z),
            .clip_w = glm::vec2(projection.w),
            .extent = {float(extent.width), float(extent.height)},
            .depth_place = first_sample_place(targets.samples()),
            .line_radius = 0.5f * scene.line_width_px * float(targets.scale()),
            .hidden_strength = scene.hidden_line_strength,
            .depth_slack = orthographic ? 0.0f : k_depth_slack,
            .depth_slack_absolute = orthographic ? k_depth_slack : 0.0f,
            .background = scene.palette.background,
            .shade = scene.palette.shade,
            .hatch_spacing = scene.hatch_spacing_px * float(targets.scale()),
            .dash_period = (scene.dash_px + scene.dash_gap_px) * float(targets.scale()),
            .dash_length = scene.dash_px * float(targets.scale()),
            .frozen_lines = scene.silhouette_camera ? 1u : 0u,
            .guard = targets.guard()};
}

gpu::InstanceData instance_data(const Scene& scene, const SceneInstance& instance,
                                const GpuMesh& mesh, VkDeviceAddress slots) {
    const Camera& camera = scene.camera;
    // The camera's silhouette point and the position that vertices are taken relative to are one and
    // the same float.
    const HomogeneousPoint eye =
        HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, camera.eye)));
    const HomogeneousPoint viewpoint = camera_point(instance, camera);
    return {.positions = mesh.positions(),
            .triangles = mesh.triangles(),
            .corner_normals = mesh.corner_normals(),
            .edges = mesh.edges(),
            .loose_edges = mesh.loose_edges(),
            .borders = mesh.borders(),
            .creases = mesh.creases(),
            .slots = slots,
            .planes = mesh.comparator() ? mesh.comparator()->planes() : 0,
            .irregular_pairs = mesh.comparator() ? mesh.comparator()->irregular_pairs() : 0,
            .eye_from_object = glm::mat3(camera_from_world(camera) * instance.rotation),
            .camera = eye.xyz(),
            .viewpoint = {viewpoint.x, viewpoint.y, viewpoint.z, viewpoint.w},
            .middle = mesh.middle(),
            .color = instance.material.color,
            .ink = line_color(scene, instance),
            .fade_radius = float(instance.fade_radius),
            .fade_center = glm::vec3(point_in_object(instance, instance.fade_center)),
            .padding = 0};
}

}  // namespace rimline
