#include "engine/frame/frame_view.h"

#include <array>
#include <glm/vec2.hpp>
#include <span>

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

std::optional<ScreenBox> screen_box_of(const FrameView& view, const SceneInstance& instance,
                                       const CasterMeshes& casters) {
    const glm::dvec2 picture(view.size.width, view.size.height);
    const auto box_of = [&](std::span<const glm::dvec3> points) {
        return screen_box(view.scene.camera, view.eye_from_world, view.projection, instance, points,
                          picture);
    };
    if (!instance.deforming)
        if (const auto caster = casters.find(&instance.mesh()); caster != casters.end())
            return box_of(caster->second.polytope());
    const CasterBox box = caster_box(instance);
    std::array<glm::dvec3, 8> corners;
    for (unsigned corner = 0; corner < corners.size(); ++corner)
        corners[corner] = {(corner & 1u) != 0 ? box.high.x : box.low.x,
                           (corner & 2u) != 0 ? box.high.y : box.low.y,
                           (corner & 4u) != 0 ? box.high.z : box.low.z};
    return box_of(corners);
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
    for (const SceneInstance& instance : seen.instances) {
        instances.push_back(view_of(seen, instance, casters));
        instances.back().screen = screen_box_of(*this, instance, casters);
    }
}

}  // namespace rimline
