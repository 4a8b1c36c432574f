#include "engine/vulkan/memory_blocks.h"

#include <cstring>
#include <mutex>
#include <vector>

#include "engine/renderer.h"
#include "engine/vulkan/memory.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

MemoryBlocks& blocks_of(const DeviceContext& context) {
    return dynamic_cast<MemoryBlocks&>(*context.allocator);
}

TEST_CASE("ten thousand silhouettes at once take fewer than a hundred allocations" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("box", 12));
    Scene scene{.camera = {.eye = {0, 0, 400}}};
    constexpr int k_side = 100;
    for (int i = 0; i < k_side * k_side; ++i)
        scene.instances.push_back({.octree = &model.octree,
                                   .translation = {3.0 * (i % k_side - k_side / 2),
                                                   3.0 * (i / k_side - k_side / 2), 0.0}});
    scene.lights.push_back({.vector = {1, 2, 3}});
    scene.shadows = false;
    const std::size_t before = blocks_of(gpu->context()).allocation_count();
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    const Picture picture = renderer.render(scene, 64, 64);
    CHECK(renderer.report().silhouette >= 4u * k_side * k_side);
    const std::size_t allocations = blocks_of(gpu->context()).allocation_count() - before;
    MESSAGE(allocations, " allocations");
    CHECK(allocations < 100);
}

TEST_CASE("buffers of a block do not touch one another's bytes") {
    RIMLINE_OPEN_GPU(gpu);
    std::vector<Buffer> buffers;
    for (std::uint32_t i = 0; i < 200; ++i) {
        buffers.emplace_back(gpu->context(), 1 + 37 * i, BufferPlace::upload, "a test");
        std::memset(buffers.back().mapped(), int(i), buffers.back().size());
        if (i % 3 == 2) buffers[i - 1] = Buffer();
    }
    for (std::uint32_t i = 0; i < buffers.size(); ++i)
        for (VkDeviceSize b = 0; b < buffers[i].size() && buffers[i].mapped(); ++b)
            REQUIRE(std::to_integer<std::uint32_t>(buffers[i].mapped()[b]) == i % 256);
}

TEST_CASE("blocks that are empty go, all but one of a kind, and that too if asked") {
    RIMLINE_OPEN_GPU(gpu);
    MemoryBlocks& blocks = blocks_of(gpu->context());
    blocks.trim();
    const std::size_t before = blocks.allocation_count();
    std::vector<Buffer> buffers;
    for (int i = 0; i < 64; ++i)
        buffers.emplace_back(gpu->context(), 1 << 20, BufferPlace::upload, "a test");
    CHECK(blocks.allocation_count() > before + 1);
    buffers.clear();
    CHECK(blocks.allocation_count() <= before + 1);
    blocks.trim();
    CHECK(blocks.allocation_count() == before);
}

// A caller's allocator: Rimline's, with everything counted.
class CountingAllocator : public MemoryAllocator {
public:
    explicit CountingAllocator(const DeviceContext& context)
        : blocks_(context.vk, context.memory, context.max_allocation_bytes) {}
    MemoryPart allocate(const MemoryRequest& request) override {
        const std::lock_guard lock(mutex_);
        const MemoryPart part = blocks_.allocate(request);
        ++live_;
        bytes_ += part.size;
        return part;
    }
    void free(const MemoryPart& part) noexcept override {
        const std::lock_guard lock(mutex_);
        blocks_.free(part);
        --live_;
    }
    int live() const { return live_; }
    VkDeviceSize bytes() const { return bytes_; }

private:
    std::mutex mutex_;
    MemoryBlocks blocks_;
    int live_ = 0;
    VkDeviceSize bytes_ = 0;
};

TEST_CASE("a caller's allocator serves all memory, and gets all of it back") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext& own = gpu->context();
    CountingAllocator allocator(own);
    const tests::Model model(make_built_in_shape("knot", 2000));
    Scene scene{.camera = {.eye = {0, 1, 4}}};
    scene.instances.push_back({.octree = &model.octree});
    scene.lights.push_back({.vector = {1, 2, 3}});
    const RendererOptions plain{.samples = 1, .scale = 1};
    Renderer expected(own, plain);
    {
        const DeviceContext context = make_device_context({.instance = gpu->instance().handle(),
                                                           .physical_device = own.physical_device,
                                                           .device = own.device,
                                                           .queue = own.queue,
                                                           .queue_family = own.queue_family,
                                                           .features = own.features,
                                                           .allocator = &allocator});
        Renderer renderer(context, plain);
        const std::size_t others = blocks_of(own).allocation_count();
        const Picture picture = renderer.render(scene, 64, 64);
        CHECK(blocks_of(own).allocation_count() == others);
        CHECK(allocator.bytes() > 16 * 64 * 64);
        CHECK(picture.rgba == expected.render(scene, 64, 64).rgba);
    }
    CHECK(allocator.live() == 0);
}

}  // namespace
}  // namespace rimline
