#include "engine/frame/frame_view.h"

#include "engine/frame/silhouette_points.h"

namespace rimline {

namespace {

InstanceView view_of(const Scene& scene, const SceneInstance& instance,
                     const CasterMeshes& casters) {
    InstanceView view{.camera = camera_point(instance, scene.camera), .lines = {}, .lights = {}};
    if (has_silhouette_lines(scene, instance))
        view.lines = camera_point(instance, lines_camera(scene));
    view.lights.reserve(scene.lights.size());
    for (const Light& light : scene.lights) {
        const HomogeneousPoint point = casting_point(scene, instance, light, casters);
        view.lights.push_back(
            {.point = point, .is_moved = !(point == light_point(instance, light))});
    }
    return view;
}

}  // namespace

FrameView::FrameView(const Scene& seen, VkExtent2D picture, const CasterMeshes& casters)
    : scene(seen),
      size(picture),
      bounds(bounds_of(seen)),
      projection(make_projection(seen.camera, double(picture.width) / picture.height, bounds.center,
                                 bounds.radius)),
      eye_from_world(camera_from_world(seen.camera)) {
    instances.reserve(seen.instances.size());
    for (const SceneInstance& instance : seen.instances)
        instances.push_back(view_of(seen, instance, casters));
}

}  // namespace rimline
