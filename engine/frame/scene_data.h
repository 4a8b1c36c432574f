#pragma once

// A scene as the shadow choice and the shaders take it: the structures of shadow_choice.h and of
// shaders/layout.h.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/frame/frame_view.h"
#include "engine/frame/render_targets.h"
#include "engine/passes/draw_list.h"
#include "engine/scene.h"
#include "engine/shadow_choice.h"
#include "engine/stream/gpu_mesh.h"
#include "shaders/layout.h"

namespace rimline {

/// The color of an instance's lines and strokes.
const glm::vec3& line_color(const Scene& scene, const SceneInstance& instance);

/// Whether its lines have the colors of its materials (Material::lines_in_mesh_colors).
bool has_material_inks(const Scene& scene, const SceneInstance& instance, const GpuMesh& mesh);

/// What gives an instance's surfaces their color in this scene. O(textures).
SurfaceColors surface_colors(const Scene& scene, const SceneInstance& instance);

/// Whether the scene is drawn as a layer (PictureUse): color premultiplied, alpha opacity.
bool is_layer(const Scene& scene, const PictureTarget& target);
/// What the surfaces of all instances of a frame share.
struct FrameSurfaces {
    bool is_layer;  ///< is_layer()
    SurfaceLights lights;
};
/// With so many samples a pixel. O(instances).
FrameSurfaces frame_surfaces(const Scene& scene, const PictureTarget& target,
                             std::uint32_t samples);
/// The pipelines that an instance needs. O(1).
SurfaceKind surface_kind(const Scene& scene, const FrameSurfaces& surfaces,
                         const SceneInstance& instance);

/// The share of a light in the light of a fully lit surface of this instance; 0 if it does not count there.
float light_share(const Scene& scene, const SceneInstance& instance, std::size_t light);
/// The share of a light among those that cast shadows; 0 for others.
float shadow_share(const Scene& scene, std::size_t light);

/// The opacity of a shadow that all lights cast on something without a color of its own.
float shadow_opacity(const Scene& scene);

/// Limit of LightData.extrusion for a point light. A light's volumes in an orthographic view reach behind
/// everything in the scene, and no farther than needed: a longer volume lowers the precision of its sides'
/// depth.
constexpr double k_max_extrusion_times = 65536.0;

/// LightData.extrusion for an orthographic view. A point light's volume begins no nearer to the light than
/// the sphere around its caster, and must end no nearer than the far side of the sphere around the scene.
float finite_extrusion(const Light& light, const SceneInstance& instance,
                       const SceneBounds& bounds);

/// The camera for choosing how `instance` casts.
ShadowView shadow_view(const FrameView& view, const SceneInstance& instance);

/// How many of a mesh's creases are drawn as lines in this scene.
std::uint32_t crease_count(const Scene& scene, const GpuMesh& mesh);

/// `targets` must have the aspect ratio that `view` was made for.
gpu::FrameData frame_data(const FrameView& view, const RenderTargets& targets);
/// Of instance `i`, without segments. `slots` is the address of the camera's silhouette, 0 where there is none.
gpu::InstanceData instance_data(const FrameView& view, std::size_t i, const GpuMesh& mesh,
                                VkDeviceAddress slots);

}  // namespace rimline
