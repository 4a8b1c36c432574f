#include "engine/vulkan/heap_room.h"

#include <algorithm>

#include "engine/vulkan/memory.h"
#include "engine/vulkan/memory_blocks.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/masking_loader.h"

namespace rimline {
namespace {

constexpr VkDeviceSize k_mib = VkDeviceSize{1} << 20;

TEST_CASE("without VK_EXT_memory_budget the budget of a heap is its size") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext& context = gpu->context();
    const std::vector<HeapRoom> rooms = heap_rooms(*context.vk, context.physical_device, false);
    REQUIRE(rooms.size() == context.memory.memoryHeapCount);
    for (std::size_t i = 0; i < rooms.size(); ++i) {
        CHECK(rooms[i].size_bytes == context.memory.memoryHeaps[i].size);
        CHECK(rooms[i].budget_bytes == rooms[i].size_bytes);
        CHECK(rooms[i].free_bytes() == rooms[i].size_bytes);
    }
    CHECK(std::ranges::any_of(rooms, &HeapRoom::is_device_local));
    CHECK(HeapRoom{.size_bytes = 9, .budget_bytes = 5, .used_bytes = 7}.free_bytes() == 0);
}

TEST_CASE(
    "where a device has VK_EXT_memory_budget it is enabled, and no memory beyond it is asked for") {
    RIMLINE_OPEN_GPU(unmasked);
    tests::Masked mask({.budget_bytes = 512 * k_mib});
    std::string reason;
    const std::unique_ptr<tests::Gpu> gpu = tests::Gpu::open(reason, &tests::masking_loader);
    REQUIRE_MESSAGE(gpu != nullptr, reason);
    const DeviceContext& context = gpu->context();
    CHECK(std::ranges::count(mask.opened_with(), VK_EXT_MEMORY_BUDGET_EXTENSION_NAME) == 1);
    CHECK(context.features.memory_budget);
    for (const HeapRoom& room : heap_rooms(*context.vk, context.physical_device, true))
        CHECK(room.budget_bytes == 512 * k_mib);

    auto& blocks = dynamic_cast<MemoryBlocks&>(*context.allocator);
    blocks.trim();
    const std::size_t before = blocks.allocation_count();
    const auto make = [&](VkDeviceSize size) {
        return Buffer(context, size, BufferPlace::upload, "a model");
    };
    // One block for both, and a large one of its own.
    const Buffer small = make(1000);
    const Buffer second = make(1000);
    const Buffer large = make(100 * k_mib);
    CHECK(blocks.allocation_count() == before + 2);

    mask.set_budget(50 * k_mib);
    try {
        make(100 * k_mib);
        FAIL("memory beyond the budget was allocated");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::too_large);
        CHECK(std::string(error.what()) ==
              "the device has no memory left for a model of 100 MiB: the system's budget "
              "(VK_EXT_memory_budget) leaves 50 MiB");
    }
    CHECK(blocks.allocation_count() == before + 2);

    // Room for a part, but not for a block of the usual size.
    mask.set_budget(k_mib);
    const Buffer in_block = make(600 << 10);
    CHECK(blocks.allocation_count() == before + 2);
    const Buffer fits = make(600 << 10);
    CHECK(blocks.allocation_count() == before + 3);
    CHECK_THROWS_AS(make(2 * k_mib), Error);
    // What there is already is shared without asking.
    mask.set_budget(0);
    const Buffer third = make(1000);
    CHECK(blocks.allocation_count() == before + 3);
    mask.set_budget(512 * k_mib);
    const Buffer again = make(2 * k_mib);
    CHECK(blocks.allocation_count() == before + 4);
}

}  // namespace
}  // namespace rimline
