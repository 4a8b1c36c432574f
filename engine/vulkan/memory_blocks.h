#pragma once

// Memory in large blocks, of which buffers and images take parts: a device allows few allocations
// (maxMemoryAllocationCount, 4096 on many), and each one is slow.
//
// There is a pool of blocks for each type of memory, one for buffers and one for images, which are not to lie
// beside one another (bufferImageGranularity). Blocks grow from 1 MiB to 64 MiB, or an eighth of the heap. What
// is larger than half a block has a VkDeviceMemory of its own. One empty block a pool is kept for what comes next.
//
// Where the device has VK_EXT_memory_budget, the budget of the heap is read before a VkDeviceMemory is allocated
// (heap_room.h): what the system leaves to this program now, which is less than the heap where others use it too.
// A new block that does not fit is made as small as its first part. A part that does not fit goes to the next type of
// memory that serves, last to one without the properties that were only wanted. It is refused where none is left; the
// driver would otherwise move memory out of the device, or fail later.

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory_allocator.h"
#include "engine/vulkan/range_allocator.h"

namespace rimline {

class MemoryBlocks : public MemoryAllocator {
public:
    /// `budget_of`: the physical device, where it has VK_EXT_memory_budget. Null: without budgets.
    explicit MemoryBlocks(std::shared_ptr<const DeviceFunctions> vk,
                          const VkPhysicalDeviceMemoryProperties& memory,
                          VkDeviceSize max_allocation_bytes,
                          VkPhysicalDevice budget_of = VK_NULL_HANDLE);
    /// All parts must be freed, and the device still be there.
    ~MemoryBlocks() override;
    MemoryBlocks(const MemoryBlocks&) = delete;
    MemoryBlocks& operator=(const MemoryBlocks&) = delete;

    MemoryPart allocate(const MemoryRequest& request) override;
    void free(const MemoryPart& part) noexcept override;

    /// Frees the empty blocks that were kept.
    void trim() noexcept;
    /// Device memories there are now.
    std::size_t allocation_count() const noexcept { return allocations_; }

private:
    struct Pool;
    struct Block;
    struct Owner;

    std::vector<std::uint32_t> types_for(const MemoryRequest& request) const;
    MemoryPart allocate(const MemoryRequest& request, std::uint32_t type);
    VkDeviceSize block_limit(std::uint32_t type) const noexcept;
    VkDeviceSize free_bytes(std::uint32_t type) const;
    std::unique_ptr<Block> make_block(const MemoryRequest& request, std::uint32_t type,
                                      VkDeviceSize size, bool dedicated);
    Pool& pool_of(const MemoryRequest& request, std::uint32_t type);

    std::shared_ptr<const DeviceFunctions> vk_;
    VkPhysicalDeviceMemoryProperties memory_;
    VkDeviceSize max_allocation_bytes_;
    VkPhysicalDevice budget_of_;
    std::atomic<std::size_t> allocations_ = 0;
    std::mutex mutex_;  // Of the pools.
    std::vector<std::unique_ptr<Pool>> pools_;
};

}  // namespace rimline
