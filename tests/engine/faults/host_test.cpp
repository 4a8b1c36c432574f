// What a caller with queues and frames of its own relies on: when the engine submits, waits and compiles. The
// loader of vulkan_faults.h counts the calls.

#include <array>
#include <mutex>

#include "engine/clouds/splat_renderer.h"
#include "engine/picture_readback.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"
#include "engine/vulkan/memory.h"
#include "tests/engine/faults/stage.h"
#include "tests/engine/support/changed_functions.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline::tests {
namespace {

constexpr RendererOptions k_host_plain{.samples = 1, .scale = 1};
constexpr VkExtent2D k_host_extent{24, 16};

class CountingMutex : public QueueMutex {
public:
    void lock() override {
        mutex_.lock();
        ++count_;
    }
    void unlock() override { mutex_.unlock(); }
    std::uint64_t count() const { return count_; }

private:
    std::mutex mutex_;
    std::uint64_t count_ = 0;
};

DeviceContext host_context(const Gpu& gpu, QueueMutex* mutex) {
    const DeviceContext& own = gpu.context();
    return make_device_context({.instance = gpu.instance().handle(),
                                .physical_device = own.physical_device,
                                .device = own.device,
                                .queue = own.queue,
                                .queue_family = own.queue_family,
                                .features = own.features,
                                .queue_mutex = mutex,
                                .loader = &failing_loader});
}

// Lines and shadows of a mesh at rest and of one that deforms.
Scene scene_of(const Gpu& gpu, const FaultModels& models) {
    Scene scene = Stage(gpu.instance(), gpu.context(), models).scene();
    const Mesh& mesh = models.box.mesh;
    scene.instances.push_back(
        {.deforming = &mesh, .deformation = default_wave(mesh, {0, 1, 0}, 0.2)});
    return scene;
}

TEST_CASE("recording a prepared frame submits nothing, waits for nothing and makes no pipeline") {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const FaultModels models;
    const Scene first = scene_of(*gpu, models);
    Scene second = first;
    second.style = Style::hatch;
    second.lights.push_back({.vector = {-1, 2, 0.5}});
    second.instances.push_back({.octree = &models.box.octree});
    Renderer renderer(gpu->context(), k_host_plain);
    const Image image = make_picture_image(gpu->context(), k_host_extent);
    for (const Scene* scene : std::array<const Scene*, 2>{&first, &second}) {
        const UploadPoint uploaded = renderer.prepare(*scene, picture_target(image));
        const auto counts = [] {
            std::vector<std::uint64_t> all;
            for (const char* function :
                 {"vkQueueSubmit2", "vkQueueSubmit", "vkQueueWaitIdle", "vkDeviceWaitIdle",
                  "vkWaitForFences", "vkWaitSemaphores", "vkCreateGraphicsPipelines",
                  "vkCreateComputePipelines", "vkCreateShaderModule"})
                all.push_back(calls_of(function));
            return all;
        };
        std::vector<std::uint64_t> before, after;
        run_commands(
            gpu->context(),
            [&](Commands commands) {
                before = counts();
                renderer.record(commands, *scene, picture_target(image));
                after = counts();
            },
            uploaded);
        CHECK(before == after);
    }
}

TEST_CASE("a caller's queue is used under the caller's lock alone, and never waited idle") {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const FaultModels models;
    const Scene scene = scene_of(*gpu, models);
    CountingMutex mutex;
    const std::uint64_t submitted = calls_of("vkQueueSubmit2");
    const std::uint64_t idle = calls_of("vkQueueWaitIdle") + calls_of("vkDeviceWaitIdle");
    {
        const DeviceContext context = host_context(*gpu, &mutex);
        Renderer renderer(context, k_host_plain);
        const Image image = make_picture_image(context, k_host_extent);
        const UploadPoint uploaded = renderer.prepare(scene, picture_target(image));
        run_commands(
            context,
            [&](Commands commands) { renderer.record(commands, scene, picture_target(image)); },
            uploaded);
        renderer.render(scene, k_host_extent.width, k_host_extent.height);
    }
    CHECK(mutex.count() > 3);
    CHECK(calls_of("vkQueueSubmit2") - submitted == mutex.count());
    CHECK(calls_of("vkQueueWaitIdle") + calls_of("vkDeviceWaitIdle") == idle);
}

TEST_CASE("the first frame waits for uploads on the GPU, even where the host has seen them done") {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const FaultModels models;
    const Scene scene = scene_of(*gpu, models);
    Renderer renderer(gpu->context(), k_host_plain);
    const UploadPoint uploaded =
        renderer.prepare(scene, {.format = k_picture_format, .extent = k_host_extent});
    REQUIRE(uploaded.value > 0);
    wait_for_timeline(gpu->context(), uploaded.timeline, uploaded.value);
    const std::uint64_t waits = semaphore_waits();
    renderer.render(scene, k_host_extent.width, k_host_extent.height);
    CHECK(semaphore_waits() == waits + 1);
    renderer.render(scene, k_host_extent.width, k_host_extent.height);
    CHECK(semaphore_waits() == waits + 1);
}

PFN_vkCmdPipelineBarrier2 record_barriers = nullptr;
std::size_t barriers = 0;          // All that were recorded.
std::size_t general_barriers = 0;  // Of these, those of every stage, or of every kind of access.

VKAPI_ATTR void VKAPI_CALL note_barriers(VkCommandBuffer commands, const VkDependencyInfo* info) {
    const auto note = [](const auto& barrier) {
        constexpr VkAccessFlags2 k_any = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
        ++barriers;
        if (((barrier.srcStageMask | barrier.dstStageMask) &
             VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0 ||
            ((barrier.srcAccessMask | barrier.dstAccessMask) & k_any) != 0)
            ++general_barriers;
    };
    for (std::uint32_t i = 0; i < info->memoryBarrierCount; ++i) note(info->pMemoryBarriers[i]);
    for (std::uint32_t i = 0; i < info->bufferMemoryBarrierCount; ++i)
        note(info->pBufferMemoryBarriers[i]);
    for (std::uint32_t i = 0; i < info->imageMemoryBarrierCount; ++i)
        note(info->pImageMemoryBarriers[i]);
    record_barriers(commands, info);
}

DeviceContext noting_barriers(const DeviceContext& context) {
    return with_functions(context, [](DeviceFunctions& vk) {
        record_barriers = vk.CmdPipelineBarrier2;
        vk.CmdPipelineBarrier2 = &note_barriers;
    });
}

TEST_CASE("a recorded frame has no barrier of all commands, unless its caller asks for one") {
    RIMLINE_OPEN_GPU(gpu);
    const FaultModels models;
    const Scene scene = scene_of(*gpu, models);
    const DeviceContext context = noting_barriers(gpu->context());
    RendererOptions options = k_host_plain;
    options.check_silhouettes = true;
    Renderer renderer(context, options);
    const Image image = make_picture_image(context, k_host_extent);
    const Image depth(
        context,
        {.format = VK_FORMAT_D32_SFLOAT,
         .extent = k_host_extent,
         .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
         .sampled_aspect = VK_IMAGE_ASPECT_DEPTH_BIT},
        "a backdrop");
    const auto general_of = [&](const PictureTarget& target) {
        const UploadPoint uploaded = renderer.prepare(scene, target);
        std::size_t general = 0;
        run_commands(
            context,
            [&](Commands commands) {
                record_barrier(
                    commands, {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
                    {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT},
                    {{depth, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL}});
                barriers = general_barriers = 0;
                renderer.record(commands, scene, target);
                CHECK(barriers > 8);
                general = general_barriers;
            },
            uploaded);
        return general;
    };
    PictureTarget target = picture_target(image);
    for (const PictureUse use : {PictureUse::whole, PictureUse::layer}) {
        CAPTURE(static_cast<int>(use));
        target.use = use;
        CHECK(general_of(target) == 0);
        PictureTarget before_depth = target;
        before_depth.backdrop = BackdropDepth{
            .image = depth.handle(), .view = depth.sampled_view(), .format = VK_FORMAT_D32_SFLOAT};
        CHECK(general_of(before_depth) == 0);
    }
    PictureTarget asked = picture_target(image);
    asked.later_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    CHECK(general_of(asked) > 0);
    PictureTarget general = picture_target(image);
    general.final_layout = VK_IMAGE_LAYOUT_GENERAL;
    CHECK(general_of(general) > 0);
}

// The validation layer checks what is recorded in one command buffer: here the end of a frame, a copy of its picture,
// and the begin of the next. (1.3.239 follows copies and changes of layout, and not the attachments of dynamic
// rendering.)
TEST_CASE("frames in one command buffer wait for each other where they must") {
    RIMLINE_OPEN_GPU(gpu);
    const FaultModels models;
    const Scene scene = scene_of(*gpu, models);
    const DeviceContext& context = gpu->context();
    for (const std::uint32_t samples : {1u, 4u}) {
        if ((context.sample_counts & samples) == 0) continue;
        Renderer renderer(context, {.samples = samples, .scale = 2, .check_silhouettes = true});
        const Image image = make_picture_image(context, k_host_extent);
        const Buffer pixels = make_picture_buffer(context, k_host_extent);
        PictureTarget target = picture_target(image);
        for (const PictureUse use : {PictureUse::whole, PictureUse::layer}) {
            target.use = use;
            const UploadPoint uploaded = renderer.prepare(scene, target);
            run_commands(
                context,
                [&](Commands commands) {
                    renderer.record(commands, scene, target);
                    record_read_back(commands, image.handle(), k_host_extent, pixels);
                    renderer.record(commands, scene, target);
                },
                uploaded);
        }
    }
    // Between frames of a cloud nothing else waits for copies.
    SplatRenderer splats(context, {.scale = 1});
    const SplatScene cloud{.camera = {.eye = {0, 0, 5}}, .radius = 1.0};
    const Image image = make_picture_image(context, k_host_extent);
    const Buffer pixels = make_picture_buffer(context, k_host_extent);
    const PictureTarget target = picture_target(image);
    const UploadPoint uploaded = splats.prepare(cloud, target);
    run_commands(
        context,
        [&](Commands commands) {
            splats.record(commands, cloud, target);
            record_read_back(commands, image.handle(), k_host_extent, pixels);
            splats.record(commands, cloud, target);
        },
        uploaded);
}

}  // namespace
}  // namespace rimline::tests
