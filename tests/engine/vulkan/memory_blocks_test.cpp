#include "engine/vulkan/memory_blocks.h"

#include <cstring>
#include <mutex>
#include <vector>

#include "engine/renderer.h"
#include "engine/vulkan/memory.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/changed_functions.h"
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

PFN_vkAllocateMemory allocate_memory = nullptr;
std::vector<std::uint32_t> tried_types;
std::uint32_t full_types = 0;  // Bit t: there is no memory of type t.

// Every type is the device's first one.
VKAPI_ATTR VkResult VKAPI_CALL allocate_where_there_is_room(VkDevice device,
                                                            const VkMemoryAllocateInfo* info,
                                                            const VkAllocationCallbacks* callbacks,
                                                            VkDeviceMemory* memory) {
    tried_types.push_back(info->memoryTypeIndex);
    if ((full_types >> info->memoryTypeIndex & 1u) != 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    VkMemoryAllocateInfo first = *info;
    first.memoryTypeIndex = 0;
    return allocate_memory(device, &first, callbacks, memory);
}

TEST_CASE(
    "where the memory that is wanted has run out another type serves that has what is needed") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext context = tests::with_functions(gpu->context(), [](DeviceFunctions& vk) {
        allocate_memory = vk.AllocateMemory;
        vk.AllocateMemory = &allocate_where_there_is_room;
    });
    constexpr VkMemoryPropertyFlags k_local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    constexpr VkMemoryPropertyFlags k_visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    constexpr VkDeviceSize k_unit = VkDeviceSize{1} << 20;
    VkPhysicalDeviceMemoryProperties memory{};
    memory.memoryHeapCount = 3;
    memory.memoryHeaps[0].size = 1024 * k_unit;
    memory.memoryHeaps[1].size = 16 * k_unit;
    memory.memoryHeaps[2].size = 1024 * k_unit;
    memory.memoryTypeCount = 4;
    memory.memoryTypes[0] = {k_visible, 0};
    memory.memoryTypes[1] = {k_local | k_visible, 1};
    memory.memoryTypes[2] = {k_local, 2};
    memory.memoryTypes[3] = {0, 0};
    MemoryBlocks blocks(context.vk, memory, ~VkDeviceSize{0});
    MemoryRequest request{.requirements = {.size = 20 * k_unit, .alignment = 16},
                          .wanted = k_local,
                          .buffer = reinterpret_cast<VkBuffer>(std::uintptr_t{8}),
                          .what = "a model"};
    const auto types_tried = [&](std::uint32_t allowed, std::uint32_t full) {
        request.requirements.memoryTypeBits = allowed;
        full_types = full;
        tried_types.clear();
        blocks.free(blocks.allocate(request));
        blocks.trim();
        return tried_types;
    };
    using Types = std::vector<std::uint32_t>;
    // Heap 1 is too small.
    CHECK(types_tried(0b1111, 0) == Types{2});
    CHECK(types_tried(0b1111, 0b0100) == Types{2, 0});
    CHECK(types_tried(0b1111, 0b0101) == Types{2, 0, 3});
    CHECK(types_tried(0b1011, 0) == Types{0});
    // Types that only some features may use are none, whatever else they have.
    for (const VkMemoryPropertyFlags special :
         {VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD, VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD,
          VK_MEMORY_PROPERTY_PROTECTED_BIT}) {
        memory.memoryTypes[2].propertyFlags = k_local | special;
        MemoryBlocks other(context.vk, memory, ~VkDeviceSize{0});
        request.requirements.memoryTypeBits = 0b1111;
        full_types = 0;
        tried_types.clear();
        other.free(other.allocate(request));
        CHECK(tried_types == Types{0});
    }
    // What is needed is not given up, and the error is that of the type that was wanted most.
    request.needed = k_visible;
    CHECK_THROWS_WITH_AS(types_tried(0b1111, 0b0001), doctest::Contains("memory of 16 MiB"), Error);
    CHECK(tried_types == Types{0});
    request.requirements.size = k_unit;
    CHECK(types_tried(0b1111, 0b0010) == Types{1, 0});
    CHECK(blocks.allocation_count() == 0);
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
