// What a caller with queues and frames of its own relies on: when the engine submits, waits and compiles. The
// loader of vulkan_faults.h counts the calls.

#include <array>
#include <mutex>

#include "engine/picture_readback.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/memory.h"
#include "tests/engine/faults/stage.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline::tests {
namespace {

constexpr RendererOptions k_plain{.samples = 1, .scale = 1};
constexpr VkExtent2D k_extent{24, 16};

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
    Renderer renderer(gpu->context(), k_plain);
    const Image image = make_picture_image(gpu->context(), k_extent);
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
        Renderer renderer(context, k_plain);
        const Image image = make_picture_image(context, k_extent);
        const UploadPoint uploaded = renderer.prepare(scene, picture_target(image));
        run_commands(
            context,
            [&](Commands commands) { renderer.record(commands, scene, picture_target(image)); },
            uploaded);
        renderer.render(scene, k_extent.width, k_extent.height);
    }
    CHECK(mutex.count() > 3);
    CHECK(calls_of("vkQueueSubmit2") - submitted == mutex.count());
    CHECK(calls_of("vkQueueWaitIdle") + calls_of("vkDeviceWaitIdle") == idle);
}

TEST_CASE("the first frame waits for uploads on the GPU, even where the host has seen them done") {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const FaultModels models;
    const Scene scene = scene_of(*gpu, models);
    Renderer renderer(gpu->context(), k_plain);
    const UploadPoint uploaded =
        renderer.prepare(scene, {.format = k_picture_format, .extent = k_extent});
    REQUIRE(uploaded.value > 0);
    wait_for_timeline(gpu->context(), uploaded.timeline, uploaded.value);
    const std::uint64_t waits = semaphore_waits();
    renderer.render(scene, k_extent.width, k_extent.height);
    CHECK(semaphore_waits() == waits + 1);
    renderer.render(scene, k_extent.width, k_extent.height);
    CHECK(semaphore_waits() == waits + 1);
}

}  // namespace
}  // namespace rimline::tests
