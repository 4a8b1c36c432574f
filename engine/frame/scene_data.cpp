#include "engine/frame/scene_data.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/frame/silhouette_points.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/rounded_to_float.h"

namespace rimline {

namespace {

static_assert(static_cast<int>(Style::ink) == RIMLINE_STYLE_INK &&
              static_cast<int>(Style::toon) == RIMLINE_STYLE_TOON &&
              static_cast<int>(Style::mask) == RIMLINE_STYLE_MASK &&
              static_cast<int>(Style::blueprint) == RIMLINE_STYLE_BLUEPRINT &&
              static_cast<int>(Style::hatch) == RIMLINE_STYLE_HATCH);

// Length of a directional light's volumes in an orthographic view, in radii of the scene: they end behind
// everything in it.
constexpr double k_finite_extrusion_radii = 8.0;

// How far behind its surface a line may lie and still be drawn, relative to its distance from the viewer
// or, in orthographic views, to the scene's depth. Lines and surfaces compute their depths from the same
// vertices by the same expressions. Interpolation rounds by about 1e-7, and line.frag's extrapolation of a
// surface to a line's spine multiplies that by a few. A hundred times 1e-7 keeps lines whole on their own
// surface. What it shows wrongly lies behind by a hundred-thousandth of its distance: a seventieth of a
// pixel's width at a field of view of 40 degrees and 1000 pixels.
constexpr float k_depth_slack = 1e-5f;

// The first sample's location within a pixel (Vulkan's standard sample locations).
glm::vec2 first_sample_place(std::uint32_t samples) {
    if (samples == 8) return {0.5625f, 0.3125f};
    if (samples == 4) return {0.375f, 0.125f};
    return samples == 2 ? glm::vec2(0.75f, 0.75f) : glm::vec2(0.5f, 0.5f);
}

GpuMesh::Creases creases_of(const Scene& scene) {
    return scene.only_clear_creases ? GpuMesh::Creases::clear : GpuMesh::Creases::all;
}

}  // namespace

float finite_extrusion(const Light& light, const SceneInstance& instance,
                       const SceneBounds& bounds) {
    if (light.directional) return float(k_finite_extrusion_radii * bounds.radius / instance.scale);
    const BoundingSphere sphere = instance.bounds();
    const glm::dvec3 center = point_in_world(instance, sphere.center);
    const double begin = glm::distance(light.vector, center) - instance.scale * sphere.radius;
    const double end = glm::distance(light.vector, bounds.center) + 1.01 * bounds.radius;
    if (begin * k_max_extrusion_times <= end) return float(k_max_extrusion_times);
    return float(end / begin);
}

ShadowView shadow_view(const FrameView& view, const SceneInstance& instance) {
    const Scene& scene = view.scene;
    const Projection& projection = view.projection;
    const glm::dvec3 back = glm::normalize(scene.camera.eye - scene.camera.target);
    ShadowView shadow{.orthographic = scene.camera.is_orthographic(),
                      // As instance_data() has it.
                      .eye = rounded_to_float(point_in_object(instance, scene.camera.eye)),
                      .back = direction_in_object(instance, back)};
    if (!shadow.orthographic) {
        // The near plane is where clip.z is clip.w; at its corners clip.x and clip.y are too.
        const double near = projection.z[1];
        shadow.near_reach =
            near / instance.scale *
            glm::length(glm::dvec3((1.0 + glm::abs(projection.shift)) / projection.scale, 1.0));
    } else {
        // Depth ends at -z[1] / z[0] along the view, and begins at (1 - z[1]) / z[0].
        const double eye = glm::dot(shadow.back, shadow.eye);
        const double per_depth = 1.0 / (projection.z[0] * instance.scale);
        shadow.far = eye - projection.z[1] * per_depth;
        if (scene.camera.projection) shadow.near = eye + (1.0 - projection.z[1]) * per_depth;
    }
    return shadow;
}

const glm::vec3& line_color(const Scene& scene, const SceneInstance& instance) {
    return instance.material.line_color ? *instance.material.line_color : scene.palette.ink;
}

bool has_material_inks(const Scene& scene, const SceneInstance& instance, const GpuMesh& mesh) {
    return instance.material.lines_in_mesh_colors && shows_colors(scene.style) &&
           mesh.materials() && !mesh.comparator();
}

SurfaceColors surface_colors(const Scene& scene, const SceneInstance& instance) {
    const FaceMaterials& materials = instance.mesh().materials();
    if (!shows_colors(scene.style) || !instance.material.shows_mesh_colors || materials.empty())
        return SurfaceColors::one;
    return materials.has_pictures() ? SurfaceColors::textures : SurfaceColors::mesh;
}

bool is_layer(const Scene& scene, const PictureTarget& target) {
    return target.use != PictureUse::whole || target.backdrop ||
           !std::ranges::all_of(scene.instances, &SceneInstance::has_surfaces);
}

FrameSurfaces frame_surfaces(const Scene& scene, const PictureTarget& target,
                             std::uint32_t samples) {
    FrameSurfaces surfaces{is_layer(scene, target), SurfaceLights::apart};
    if (scene.lights.size() != 1) return surfaces;
    if (!scene.shadows || !scene.lights[0].casts_shadows) {
        surfaces.lights = SurfaceLights::together;
        return surfaces;
    }
    // Shadows of one sample cannot take their color from an image with a color for all samples of a pixel. Those on
    // backdrops, and on what has no color of its own, are no colors of surfaces.
    if (samples == 1 && !target.backdrop &&
        std::ranges::all_of(scene.instances, &SceneInstance::has_surfaces))
        surfaces.lights = SurfaceLights::beside_shadow;
    return surfaces;
}

namespace {

// By whether strokes of Style::hatch are lighter than the surface.
SurfaceFilling filling_of(const Scene& scene, const SceneInstance& instance, SurfaceColors colors) {
    if (scene.style != Style::hatch) return SurfaceFilling::lighter;
    const auto filling = [](bool has_light_strokes) {
        return has_light_strokes ? SurfaceFilling::darker : SurfaceFilling::lighter;
    };
    if (colors == SurfaceColors::one) {
        const glm::vec3& surface = instance.material.color;
        const glm::vec3& ink = line_color(scene, instance);
        return filling(ink.x + ink.y + ink.z > surface.x + surface.y + surface.z);
    }
    return instance.material.lines_in_mesh_colors ? filling(scene.palette.has_light_ink())
                                                  : SurfaceFilling::left_out;
}

}  // namespace

SurfaceKind surface_kind(const Scene& scene, const FrameSurfaces& surfaces,
                         const SceneInstance& instance) {
    SurfaceKind kind{.fades = instance.fade_radius > 0.0, .lights = surfaces.lights};
    if (instance.has_surfaces || scene.style == Style::hatch)
        kind.style = static_cast<std::uint32_t>(scene.style);
    if (instance.has_surfaces) {
        kind.colors = surface_colors(scene, instance);
        kind.output = surfaces.is_layer ? SurfaceOutput::layer : SurfaceOutput::picture;
    } else {
        kind.output = SurfaceOutput::held_out;
    }
    // Strokes and the colors of corners are no functions of a vertex.
    kind.shades_vertices = kind.lights == SurfaceLights::apart &&
                           kind.style != RIMLINE_STYLE_HATCH && kind.colors == SurfaceColors::one &&
                           instance.mesh().vertex_count() <= k_max_indexed_vertices;
    // What fades is lit by casters of shadows alone.
    if (kind.lights == SurfaceLights::apart && kind.output != SurfaceOutput::held_out &&
        !kind.fades && std::ranges::any_of(scene.lights, &Light::fills)) {
        kind.filling = filling_of(scene, instance, kind.colors);
    }
    return kind;
}

namespace {

float share_of(const Scene& scene, const Light& light) {
    return light.share.value_or(1.0f / float(scene.lights.size()));
}

}  // namespace

float light_share(const Scene& scene, const SceneInstance& instance, std::size_t light) {
    if (instance.fade_radius > 0.0) return shadow_share(scene, light);
    return share_of(scene, scene.lights[light]);
}

float shadow_share(const Scene& scene, std::size_t light) {
    if (!scene.lights[light].casts_shadows) return 0.0f;
    float sum = 0.0f;
    for (const Light& each : scene.lights)
        if (each.casts_shadows) sum += share_of(scene, each);
    return share_of(scene, scene.lights[light]) / sum;
}

float shadow_opacity(const Scene& scene) {
    return 1.0f - glm::dot(scene.palette.shade, glm::vec3(1.0f / 3.0f));
}

std::uint32_t crease_count(const Scene& scene, const GpuMesh& mesh) {
    if (scene.crease_angle_deg <= 0.0f) return 0;
    return mesh.crease_count(creases_of(scene), glm::radians(scene.crease_angle_deg));
}

gpu::FrameData frame_data(const FrameView& view, const RenderTargets& targets) {
    const Scene& scene = view.scene;
    const Projection& projection = view.projection;
    const VkExtent2D extent = targets.pass_extent();
    const bool orthographic = scene.camera.is_orthographic();
    return {.clip_scale = glm::vec2(projection.scale) / targets.guard(),
            .clip_shift = glm::vec2(projection.shift) / targets.guard(),
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
            .dash_period = scene.dash_gap_px > 0.0f
                               ? (scene.dash_px + scene.dash_gap_px) * float(targets.scale())
                               : 0.0f,
            .dash_length = scene.dash_px * float(targets.scale()),
            .frozen_lines = scene.silhouette_camera ? 1u : 0u,
            .guard = targets.guard()};
}

namespace {

std::uint32_t stroke_inks(const Scene& scene, const SceneInstance& instance, bool has_colors) {
    if (!has_colors || !instance.material.lines_in_mesh_colors) return RIMLINE_STROKES_OWN;
    return scene.palette.has_light_ink() ? RIMLINE_STROKES_PALE : RIMLINE_STROKES_DARK;
}

}  // namespace

gpu::InstanceData instance_data(const FrameView& view, std::size_t i, const GpuMesh& mesh,
                                VkDeviceAddress slots) {
    const SceneInstance& instance = view.scene.instances[i];
    const HomogeneousPoint& viewpoint = view.instances[i].camera;
    // The camera's silhouette point and the position that vertices are taken relative to are the same
    // float.
    const HomogeneousPoint eye =
        HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, view.scene.camera.eye)));
    // Otherwise null, and the shaders do not read them.
    const SurfaceColors kind = surface_colors(view.scene, instance);
    const GpuMaterials* colors = kind == SurfaceColors::one ? nullptr : &*mesh.materials();
    const GpuMaterials* inks =
        has_material_inks(view.scene, instance, mesh) ? &*mesh.materials() : nullptr;
    const GpuTextures* textures = kind == SurfaceColors::textures ? &*colors->textures() : nullptr;
    const glm::mat3 eye_from_object(instance.scale * (view.eye_from_world * instance.rotation));
    return {.positions = mesh.positions(),
            .triangles = mesh.triangles(),
            .corner_normals = mesh.corner_normals(),
            .edges = mesh.edges(),
            .loose_edges = mesh.loose_edges(),
            .borders = mesh.borders(),
            .creases = mesh.creases(creases_of(view.scene)),
            .slots = slots,
            .planes = mesh.comparator() ? mesh.comparator()->planes() : 0,
            .irregular_pairs = mesh.comparator() ? mesh.comparator()->irregular_pairs() : 0,
            .segments = 0,
            .materials = colors ? colors->base_colors() : 0,
            .face_materials = colors ? colors->of_face() : 0,
            .corner_colors = colors ? colors->corner_colors() : 0,
            .face_inks = inks ? inks->face_inks() : 0,
            .hull_normals = mesh.hull_normals(),
            .textured_faces = textures ? textures->faces() : 0,
            .corner_uvs = textures ? textures->corner_uvs() : 0,
            .eye_from_object = eye_from_object,
            .inverse_scale = float(1.0 / instance.scale),
            .camera = eye.xyz(),
            .viewpoint = {viewpoint.x, viewpoint.y, viewpoint.z, viewpoint.w},
            .center = mesh.center(),
            .color = instance.material.color,
            .ink = line_color(view.scene, instance),
            .fade_radius = float(instance.fade_radius / instance.scale),
            .fade_center = glm::vec3(point_in_object(instance, instance.fade_center)),
            .has_corner_colors = colors && colors->has_corner_colors() ? 1u : 0u,
            .stroke_inks = stroke_inks(view.scene, instance, colors != nullptr)};
}

}  // namespace rimline
