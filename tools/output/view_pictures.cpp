#include "tools/output/view_pictures.h"

#include <optional>

#include "engine/measure/view_ratios.h"
#include "engine/view_defaults.h"
#include "tools/options/model_argument.h"
#include "tools/options/model_octree.h"
#include "tools/options/picture_scene.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/three_point.h"
#include "tools/options/view_camera.h"
#include "tools/progress.h"

namespace rimline::tools {

ViewDevice::ViewDevice(const std::string& model, const Mesh& mesh, const PictureOptions& options,
                       bool draws, const Context& context) {
    if (!draws) return;
    device.emplace(options);
    context.times.end("device");
    octree.emplace(build_octree(model, mesh, context));
}

Camera make_view_camera(const Mesh& mesh, const glm::dvec3& eye, const PictureOptions& options,
                        ImageSize size) {
    const ViewCamera camera =
        camera_of_view(mesh, eye, up_of(mesh, options), double(size.width) / size.height);
    return {
        .eye = camera.eye, .target = camera.target, .up = camera.up, .fov_y_deg = camera.fov_y_deg};
}

Scene make_view_scene(const Mesh& mesh, const LightedView& view, const SceneOptions& style,
                      const PictureOptions& options, ImageSize size) {
    const double aspect = double(size.width) / size.height;
    Scene scene =
        style.make_scene(make_view_camera(mesh, view.eye, options, size), view.lights, options);
    if (style.ground && scene.shadows)
        scene.camera = zoom_with_shadows(scene.camera, mesh, scene.lights,
                                         ground_up_of(mesh, options), aspect);
    if (options.is_three_point()) add_fill_and_rim(scene);
    return scene;
}

std::vector<Picture> draw_views(Renderer& renderer, const ViewScene& scene,
                                std::span<const LightedView> views, ImageSize size,
                                const Context& context) {
    const Mesh& mesh = scene.octree.mesh();
    std::vector<glm::dvec3> eyes;
    for (const LightedView& view : views) eyes.push_back(view.eye);
    check_scene_reach(scene.model, mesh, eyes, scene.style.ground);
    const glm::dvec3 up = up_of(mesh, scene.picture);
    std::optional<Ground> ground;
    if (scene.style.ground) ground.emplace(mesh, up, 0.0);
    Progress progress(context, "drawing views");
    const LongCall call = progress.call();
    std::vector<Picture> pictures;
    const auto finish_one = [&] {
        pictures.push_back(renderer.finish());
        scene.style.finish(scene.picture).apply(pictures.back());
    };
    // The lines of a picture are found while the one before is drawn.
    for (std::size_t i = 0; i < views.size(); ++i) {
        const LightedView& view = views[i];
        call.checkpoint(double(i) / double(views.size()));
        Scene picture_scene = make_view_scene(mesh, view, scene.style, scene.picture, size);
        picture_scene.instances.push_back({.octree = &scene.octree,
                                           .name = scene.model,
                                           .material = scene.style.material(scene.picture)});
        if (scene.lines && picture_scene.lines)
            picture_scene.instances.front().picture_lines = scene.lines->draw(
                picture_scene.camera, size, scene.style.line_style(picture_scene.palette),
                {context.stop, {}});
        if (ground)
            picture_scene.instances.push_back(
                ground->instance(picture_scene, fade_of_ground(mesh, picture_scene.lights, up)));
        renderer.submit(picture_scene, size.width, size.height);
        if (i > 0) finish_one();
    }
    if (!views.empty()) finish_one();
    return pictures;
}

ChosenViews choose_views(const ViewChoice& choice, const std::string& model, const Mesh& mesh,
                         const glm::dvec3& up, const ViewDevice& view_device,
                         std::uint32_t min_count, const Context& context) {
    check_viewing_range(model, mesh);
    if (choice.no_ratio) return choice.choose(model, mesh, up, {}, min_count, context);
    ViewRatios ratios(view_device.device->context(), *view_device.octree, context.stop);
    return choice.choose(
        model, mesh, up,
        [&](std::span<const glm::dvec3> eyes) { return ratios.measure(eyes, context.stop); },
        min_count, context);
}

}  // namespace rimline::tools
