#pragma once

// A scene as one frame sees it: its bounds, the projection, and every silhouette point of every instance,
// computed once for all steps of the frame.

#include <vulkan/vulkan.h>

#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "engine/camera.h"
#include "engine/frame/caster_mesh.h"
#include "engine/frame/screen_box.h"
#include "engine/scene.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// A light in an instance's coordinates.
struct LightView {
    HomogeneousPoint point;  ///< casting_point().
    bool is_moved = false;   ///< The light lay on a vertex; `point` lies beside it.
};

/// One instance in one frame, in its own coordinates.
struct InstanceView {
    HomogeneousPoint camera;                ///< Of Scene::camera.
    std::optional<HomogeneousPoint> lines;  ///< Of lines_camera(); see has_silhouette_lines().
    std::vector<LightView> lights;          ///< One for each light of the scene.
    /// Where its surfaces can be on the screen (screen_box()).
    std::optional<ScreenBox> screen = std::nullopt;
};

struct FrameView {
    /// For a picture of `size`. Holds a reference: `scene` must outlive it. Around a mesh that is not
    /// among `casters`, or deforms, a box is taken; lights that cast shadows need it there, as casting_point() says.
    /// O(instances * lights).
    FrameView(const Scene& scene, VkExtent2D size, const CasterMeshes& casters);

    const Scene& scene;
    VkExtent2D size;
    SceneBounds bounds;
    Projection projection;
    glm::dmat3 eye_from_world;            ///< camera_from_world() of Scene::camera.
    std::vector<InstanceView> instances;  ///< One for each instance of the scene.
};

}  // namespace rimline
