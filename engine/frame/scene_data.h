#pragma once

// A scene as trackers, choices and shaders take it: points of the world in each instance's own
// coordinates, and the structures of shaders/layout.h.
//
// Lights and cameras go to an instance's coordinates once, in double, and are rounded to float there. What
// a tracker follows, what a volume is extruded from and what vertices are taken relative to are then one
// and the same float.

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/camera.h"
#include "engine/frame/render_targets.h"
#include "engine/scene.h"
#include "engine/shadow_choice.h"
#include "engine/stream/gpu_mesh.h"
#include "shaders/layout.h"

namespace rimline {

/// Whether an instance's lines are drawn, and whether its shadow is.
bool has_lines(const Scene& scene, const SceneInstance& instance);
bool casts_shadows(const Scene& scene, const SceneInstance& instance);

/// What its lines and strokes are drawn with.
const glm::vec3& line_color(const Scene& scene, const SceneInstance& instance);

/// From where lines are silhouettes: the camera, unless they are frozen.
const Camera& lines_camera(const Scene& scene);

/// Silhouette points in the instance's coordinates.
HomogeneousPoint camera_point(const SceneInstance& instance, const Camera& camera);
HomogeneousPoint light_point(const SceneInstance& instance, const Light& light);
/// From where a light casts: what has a volume needs a light that is on none of its vertices.
HomogeneousPoint casting_point(const Scene& scene, const SceneInstance& instance,
                               const Light& light);

/// A light's volumes in an orthographic view reach behind everything there is, and no farther than that
/// needs: what they stretch over costs the depth of their sides its precision.
constexpr double k_max_extrusion_times = 65536.0;

/// LightData.extrusion for an orthographic view. A point light's volume begins no nearer to it than the
/// sphere around its caster, and must end no nearer than the far side of the sphere around the scene.
float finite_extrusion(const Light& light, const SceneInstance& instance,
                       const SceneBounds& bounds);

/// The camera for choosing how `instance` casts.
ShadowView shadow_view(const Scene& scene, const SceneInstance& instance,
                       const Projection& projection);

/// Holds all of an instance in its own coordinates.
struct CasterBox {
    glm::dvec3 low, high;
};
CasterBox caster_box(const SceneInstance& instance);

/// Where in a picture of `size` anything of the scene may be, lines and what they look at around
/// them included: a rectangle around its instances' boxes, all of the picture where one reaches
/// behind the near plane. Where nothing is in the picture it is one pixel, for a pass needs one.
VkRect2D drawn_rect(const Scene& scene, VkExtent2D size);

/// How many of a mesh's creases are lines in this scene.
std::uint32_t crease_count(const Scene& scene, const GpuMesh& mesh);

gpu::FrameData frame_data(const Scene& scene, const RenderTargets& targets);
/// `slots` is the address of the camera's silhouette, 0 where there is none.
gpu::InstanceData instance_data(const Scene& scene, const SceneInstance& instance,
                                const GpuMesh& mesh, VkDeviceAddress slots);

}  // namespace rimline
