#include "tools/output/still_scene.h"

#include <array>

#include "tools/options/option_types.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/three_point.h"
#include "tools/options/view_camera.h"

namespace rimline::tools {

StillScene::StillScene(const std::string& name, const HoughOctree& octree,
                       const SceneOptions& style, const PictureOptions& picture,
                       const LongCall& call)
    : style_(style), picture_(picture) {
    const Mesh& mesh = octree.mesh();
    const Camera camera = make_camera(mesh, name, picture);
    const double aspect = double(picture.size.width) / picture.size.height;
    scene_ = style.make_scene(camera,
                              SceneLights(picture, mesh, style.ground, call.part(0.0, 0.4))
                                  .lights(camera, aspect, call.part(0.4, 1.0)),
                              picture);
    ground_up_ = rounded_to_float(ground_up_of(mesh, picture));
    if (style.ground) frame_ground(scene_, mesh, picture);
    if (picture.is_three_point()) add_fill_and_rim(scene_);
    scene_.silhouette_camera =
        silhouette_camera_of(mesh, camera, in_double(picture.silhouette_from), picture);
    const std::array eyes{scene_.camera.eye, scene_.silhouette_camera.value_or(scene_.camera).eye};
    check_scene_reach(name, mesh, eyes, style.ground);
    scene_.instances.push_back(
        {.octree = &octree, .name = name, .material = style.material(picture)});
    if (!style.ground) return;
    ground_.emplace(mesh, ground_up_, 0.0);
    scene_.instances.push_back(
        ground_->instance(scene_, fade_of_ground(mesh, scene_.lights, ground_up_)));
}

// The ground hides no line: the model stands on it, and from below it is not drawn.
void StillScene::add_lines(ShownLines& lines, const LongCall& call) {
    if (!has_exact_lines()) return;
    scene_.instances.front().picture_lines =
        lines.draw(scene_.camera, picture_.size, style_.line_style(scene_.palette), call);
}

}  // namespace rimline::tools
