#include "engine/frame/frame_passes.h"

#include "engine/picture_readback.h"
#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "engine/vulkan/commands.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/changed_functions.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

PFN_vkCmdBeginRendering passes_begin = nullptr;
int begun_passes = 0;

VKAPI_ATTR void VKAPI_CALL count_pass(VkCommandBuffer commands, const VkRenderingInfo* info) {
    ++begun_passes;
    passes_begin(commands, info);
}

TEST_CASE("a frame without lines has no scope for them") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext context = tests::with_functions(gpu->context(), [](DeviceFunctions& vk) {
        passes_begin = vk.CmdBeginRendering;
        vk.CmdBeginRendering = &count_pass;
    });
    const tests::Model model(make_built_in_shape("box", 12));
    constexpr VkExtent2D k_size{64, 64};
    const Image image = make_picture_image(context, k_size);
    PictureTarget target = picture_target(image);
    Renderer renderer(context, {.samples = 1, .scale = 1});
    const auto passes = [&](const Scene& scene, PictureUse use) {
        target.use = use;
        const UploadPoint uploaded = renderer.prepare(scene, target);
        run_commands(
            context,
            [&](Commands commands) {
                begun_passes = 0;
                renderer.record(commands, scene, target);
            },
            uploaded);
        return begun_passes;
    };
    Scene scene{.camera = fit_camera({}, model.mesh, default_view_direction({0, 1, 0}), 1.0)};
    scene.instances.push_back({.octree = &model.octree});
    CHECK(passes(scene, PictureUse::whole) == 3);
    CHECK(passes(scene, PictureUse::layer) == 4);
    scene.lines = false;
    CHECK(passes(scene, PictureUse::whole) == 2);
    CHECK(passes(scene, PictureUse::layer) == 2);
    scene.palette.grid_strength = 0.5f;
    CHECK(passes(scene, PictureUse::whole) == 3);
}

}  // namespace
}  // namespace rimline
