#include "tools/bindings/bound_renderer.h"

#include <algorithm>

#include "engine/measure/view_ratios.h"
#include "silhouette/field/ray_ratios.h"
#include "tools/options/model_argument.h"
#include "tools/options/up_option.h"
#include "tools/output/still_scene.h"

namespace rimline::tools {

namespace {

PictureOptions device_options(const std::string& device, bool validates) {
    PictureOptions options;
    options.device = device;
    options.validate = validates;
    return options;
}

}  // namespace

RenderOptions::RenderOptions() {
    style.add_to(app);
    style.add_palette_to(app);
    style.add_exact_lines_to(app);
    picture.add_silhouette_to(app);
    picture.add_camera_to(app);
    picture.add_ground_up_to(app);
    picture.add_lights_to(app);
    picture.add_image_to(app, PictureOptions::Background::any);
}

BoundRenderer::BoundRenderer(const std::string& device, bool validates)
    : device_(device_options(device, validates)) {}

Picture BoundRenderer::render(const SharedMesh& shared, RenderOptions& options,
                              const LongCall& call) {
    const Mesh& mesh = shared->mesh();
    if (!mesh.is_welded())
        throw UsageError("pictures need a mesh whose equal positions are one vertex");
    options.style.check_usage(options.picture);
    options.style.check_lines();
    check_has_extent(shared->name(), mesh);
    const glm::dvec3 up =
        settle_up(mesh, options.picture.up, options.picture.is_up_auto, call.stop).up;
    // Shares of igea's time with lines and a chosen view. The device draws for the last third, which reports nothing.
    const HoughOctree& octree = shared->octree(call.part(0.0, 0.15));
    const Turns::Turn turn(turns_, call);
    if (std::ranges::find(meshes_, shared) == meshes_.end()) meshes_.push_back(shared);
    if (!options.picture.eye)
        options.picture.view.choose(shared->name(), mesh, up, call.part(0.15, 0.25));
    StillScene still(shared->name(), octree, options.style, options.picture, call.part(0.25, 0.4));
    if (still.has_exact_lines()) {
        if (!lines_ || &lines_->surface().mesh() != &mesh) {
            lines_.reset();
            lines_.emplace(octree, shared->line_surface(call.part(0.4, 0.6)));
        }
        still.add_lines(*lines_, call.part(0.6, 0.65));
    }
    if (!renderer_) renderer_.emplace(device_.context());
    const ImageSize size = options.picture.size;
    Picture picture = renderer_->render(still.scene(), size.width, size.height);
    if (lines_ && &lines_->surface().mesh() != &mesh) lines_.reset();
    std::erase_if(meshes_, [&](const SharedMesh& other) { return other != shared; });
    call.checkpoint(1.0);
    options.style.finish(options.picture).apply(picture);
    return picture;
}

void BoundRenderer::measure(BoundMesh& mesh, const LongCall& call,
                            const std::function<void(const VisibleRatios& ratios)>& use) {
    const HoughOctree& octree = mesh.octree(call);
    const Turns::Turn turn(turns_, call);
    ViewRatios ratios(device_.context(), octree, call.stop);
    use([&](std::span<const glm::dvec3> eyes) { return ratios.measure(eyes, call.stop); });
}

void measure_views(BoundMesh& mesh, BoundRenderer* renderer, const LongCall& call,
                   const std::function<void(const VisibleRatios& ratios)>& use) {
    if (renderer != nullptr) return renderer->measure(mesh, call, use);
    const RayRatios rays(mesh.octree(call), {}, call);
    use([&](std::span<const glm::dvec3> eyes) { return rays.measure(eyes, call.stop); });
}

}  // namespace rimline::tools
