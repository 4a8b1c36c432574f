#include "engine/frame/render_targets.h"

#include <algorithm>
#include <vector>

#include "engine/picture_readback.h"
#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/changed_functions.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

constexpr VkExtent2D k_scope_size{160, 96};

// A scope of rendering, with one color attachment or several.
struct NotedScope {
    VkRect2D area;
    VkImageView color;
    VkAttachmentStoreOp depth_store;
};

PFN_vkCmdBeginRendering scope_begin = nullptr;
std::vector<NotedScope> noted_scopes;

VKAPI_ATTR void VKAPI_CALL note_scope(VkCommandBuffer commands, const VkRenderingInfo* info) {
    noted_scopes.push_back({info->renderArea, info->pColorAttachments[0].imageView,
                            info->pDepthAttachment ? info->pDepthAttachment->storeOp
                                                   : VK_ATTACHMENT_STORE_OP_MAX_ENUM});
    scope_begin(commands, info);
}

DeviceContext noting_scopes(const DeviceContext& context) {
    return tests::with_functions(context, [](DeviceFunctions& vk) {
        scope_begin = vk.CmdBeginRendering;
        vk.CmdBeginRendering = &note_scope;
    });
}

class ScopeScene {
public:
    ScopeScene() : model_(make_built_in_shape("knot", 2000)) {
        scene.camera = fit_camera({}, model_.mesh, default_view_direction({0, 1, 0}),
                                  double(k_scope_size.width) / k_scope_size.height);
        scene.instances.push_back({.octree = &model_.octree});
    }
    Scene scene;

private:
    tests::Model model_;
};

// The scopes of a frame into a target that is used so.
std::vector<NotedScope> scopes_of(const DeviceContext& context, const RendererOptions& options,
                                  const Scene& scene, PictureUse use, VkImageView* view = nullptr) {
    Renderer renderer(context, options);
    const Image image = make_picture_image(context, k_scope_size);
    PictureTarget target = picture_target(image);
    target.use = use;
    if (use == PictureUse::over) {
        // Something to draw over.
        run_commands(context, [&](Commands commands) {
            record_barrier(
                commands, {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
                {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                 VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT},
                {{image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}});
        });
        target.initial_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    if (view) *view = target.view;
    const UploadPoint uploaded = renderer.prepare(scene, target);
    run_commands(
        context,
        [&](Commands commands) {
            noted_scopes.clear();
            renderer.record(commands, scene, target);
        },
        uploaded);
    return noted_scopes;
}

TEST_CASE("a frame over a picture reads and writes no more of it than it draws") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext context = noting_scopes(gpu->context());
    const ScopeScene drawn;
    const RendererOptions plain{.samples = 1, .scale = 1};
    VkImageView view = VK_NULL_HANDLE;
    const NotedScope over = scopes_of(context, plain, drawn.scene, PictureUse::over, &view).back();
    REQUIRE(over.color == view);
    CHECK(over.area.extent.width > 16);
    CHECK(over.area.extent.width < k_scope_size.width);
    // A layer clears what is around.
    CHECK(scopes_of(context, plain, drawn.scene, PictureUse::layer).back().area.extent.width ==
          k_scope_size.width);
}

TEST_CASE("the depth of shapes is not stored") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext context = noting_scopes(gpu->context());
    const ScopeScene drawn;
    const std::vector<NotedScope> scopes =
        scopes_of(context, {.samples = 1, .scale = 1, .outline = {.method = OutlineMethod::sobel}},
                  drawn.scene, PictureUse::whole);
    CHECK(scopes.front().depth_store == VK_ATTACHMENT_STORE_OP_DONT_CARE);
}

PFN_vkCmdPipelineBarrier2 target_barrier = nullptr;
std::vector<VkImage> barrier_images;
std::vector<VkMemoryBarrier2> memory_barriers;

VKAPI_ATTR void VKAPI_CALL note_target_barrier(VkCommandBuffer commands,
                                               const VkDependencyInfo* info) {
    for (std::uint32_t i = 0; i < info->imageMemoryBarrierCount; ++i)
        barrier_images.push_back(info->pImageMemoryBarriers[i].image);
    memory_barriers.insert(memory_barriers.end(), info->pMemoryBarriers,
                           info->pMemoryBarriers + info->memoryBarrierCount);
    target_barrier(commands, info);
}

TEST_CASE("a backdrop with a stencil may be in a layout of its depth alone") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext context = tests::with_functions(gpu->context(), [](DeviceFunctions& vk) {
        target_barrier = vk.CmdPipelineBarrier2;
        vk.CmdPipelineBarrier2 = &note_target_barrier;
    });
    const BackdropDepth backdrop{.image = reinterpret_cast<VkImage>(std::uintptr_t{8}),
                                 .format = VK_FORMAT_D32_SFLOAT_S8_UINT,
                                 .earlier_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                 .layout = VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL};
    run_commands(context, [&](Commands commands) {
        barrier_images.clear();
        memory_barriers.clear();
        RenderTargets::record_before_backdrop(commands, backdrop);
        CHECK(barrier_images.empty());
        REQUIRE(memory_barriers.size() == 1);
        CHECK(memory_barriers[0].dstStageMask == VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
        CHECK((memory_barriers[0].srcStageMask & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT) != 0);
        CHECK((memory_barriers[0].srcStageMask & VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT) != 0);
    });
}

TEST_CASE("the scale is one whose images a device can draw into") {
    RIMLINE_OPEN_GPU(gpu);
    DeviceContext context = gpu->context();
    CHECK(fitting_scale(context, {100, 50}, 3, 1) == 3);
    context.limits.maxFramebufferWidth = 250;
    CHECK(fitting_scale(context, {100, 50}, 3, 1) == 2);
    context.limits.maxFramebufferHeight = 99;
    CHECK(fitting_scale(context, {100, 50}, 3, 1) == 1);
}

}  // namespace
}  // namespace rimline
