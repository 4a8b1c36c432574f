#include "tools/view_pictures.h"

#include <algorithm>
#include <glm/common.hpp>
#include <optional>

#include "engine/view_defaults.h"
#include "tools/picture_scene.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

// What is drawn must lie within the coordinates that silhouettes are found in.
void check_size(const ViewScene& scene, std::span<const glm::dvec3> eyes) {
    const Mesh& mesh = scene.octree.mesh();
    glm::dvec3 reach = glm::abs(mesh.center()) + scene_reach(mesh, scene.style.ground);
    for (const glm::dvec3& eye : eyes) reach = glm::max(reach, glm::abs(eye));
    if (std::max({reach.x, reach.y, reach.z}) > double{k_max_coordinate})
        throw Error(
            ErrorCode::too_large,
            scene.model + ": too large to stand before: scale it down, coordinates end at 2^60");
}

}  // namespace

VisibleRatios visible_ratios_of(VisibleRatioPass& pass, const Context& context) {
    return [&pass, stop = context.stop](std::span<const glm::dvec3> eyes) {
        std::vector<double> ratios;
        ratios.reserve(eyes.size());
        for (const VisibleRatio& ratio : pass.measure(eyes, {stop, {}}))
            ratios.push_back(ratio.ratio());
        return ratios;
    };
}

std::vector<Picture> draw_views(Renderer& renderer, const ViewScene& scene,
                                std::span<const glm::dvec3> eyes, ImageSize size,
                                const Context& context) {
    check_size(scene, eyes);
    const Mesh& mesh = scene.octree.mesh();
    const glm::dvec3 up = up_of(mesh, scene.picture);
    std::optional<Ground> ground;
    if (scene.style.ground) ground.emplace(mesh, up, 0.0);
    Progress progress(context, "drawing views");
    const LongCall call = progress.call();
    std::vector<Picture> pictures;
    for (const glm::dvec3& eye : eyes) {
        call.checkpoint(double(pictures.size()) / double(eyes.size()));
        Camera camera{.eye = eye, .target = mesh.center(), .up = up};
        camera = zoom_camera(camera, mesh, double(size.width) / size.height);
        Scene drawn = scene.style.make_scene(camera, mesh, scene.picture);
        drawn.instances.push_back({.octree = &scene.octree,
                                   .name = scene.model,
                                   .material = scene.style.material(scene.picture)});
        if (ground) drawn.instances.push_back(ground->instance(drawn));
        pictures.push_back(renderer.render(drawn, size.width, size.height));
    }
    return pictures;
}

}  // namespace rimline::tools
