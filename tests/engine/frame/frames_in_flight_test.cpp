#include "engine/frame/frames_in_flight.h"

#include <algorithm>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/changed_functions.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

PFN_vkCmdPipelineBarrier2 frame_barrier = nullptr;
std::vector<VkMemoryBarrier2> frame_barriers;

VKAPI_ATTR void VKAPI_CALL note_frame_barrier(VkCommandBuffer commands,
                                              const VkDependencyInfo* info) {
    frame_barriers.insert(frame_barriers.end(), info->pMemoryBarriers,
                          info->pMemoryBarriers + info->memoryBarrierCount);
    frame_barrier(commands, info);
}

bool waits_for_vertices(const VkMemoryBarrier2& barrier) {
    return (barrier.dstStageMask & VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT) != 0;
}

TEST_CASE("vertex shaders wait for nothing in a frame whose silhouettes do not change") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext context = tests::with_functions(gpu->context(), [](DeviceFunctions& vk) {
        frame_barrier = vk.CmdPipelineBarrier2;
        vk.CmdPipelineBarrier2 = &note_frame_barrier;
    });
    const tests::Model model(make_built_in_shape("torus", 2000));
    Scene scene{.camera = fit_camera({}, model.mesh, default_view_direction({0, 1, 0}), 1.0)};
    scene.instances.push_back({.octree = &model.octree});
    scene.lights.push_back(default_sun(scene.camera));
    Renderer renderer(context, {.samples = 1, .scale = 1, .line_path = LinePath::pulling});
    const auto waiting = [&] {
        frame_barriers.clear();
        renderer.render(scene, 32, 32);
        return std::ranges::count_if(frame_barriers, waits_for_vertices);
    };
    CHECK(waiting() == 1);
    for (int frame = 0; frame < 3; ++frame) CHECK(waiting() == 0);
    scene.camera.eye *= 1.1;
    CHECK(waiting() == 1);
    CHECK(waiting() == 0);
}

}  // namespace
}  // namespace rimline
