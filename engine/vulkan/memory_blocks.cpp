#include "engine/vulkan/memory_blocks.h"

#include <algorithm>
#include <bit>
#include <exception>
#include <utility>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/heap_room.h"
#include "engine/vulkan/memory_budget.h"
#include "engine/vulkan/vulkan_result.h"

namespace rimline {

namespace {

constexpr VkDeviceSize k_first_block_bytes = VkDeviceSize{1} << 20;
constexpr VkDeviceSize k_max_block_bytes = VkDeviceSize{64} << 20;

// Types with these are for devices whose features ask for them.
constexpr VkMemoryPropertyFlags k_special_types = VK_MEMORY_PROPERTY_PROTECTED_BIT |
                                                  VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD |
                                                  VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD;

}  // namespace

// One VkDeviceMemory.
struct MemoryBlocks::Block {
    Block(MemoryBlocks& of, VkDeviceSize size) : ranges(size), blocks_(of) {}
    ~Block() {
        if (memory == VK_NULL_HANDLE) return;
        blocks_.vk_->FreeMemory(blocks_.vk_->device, memory, nullptr);
        --blocks_.allocations_;
    }
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;

    Pool* pool = nullptr;  // Null: it serves one owner.
    RangeAllocator ranges;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;

private:
    MemoryBlocks& blocks_;
};

struct MemoryBlocks::Pool {
    std::uint32_t type;
    bool for_images;
    bool is_mapped;
    VkDeviceSize next_block_bytes = k_first_block_bytes;
    std::vector<std::unique_ptr<Block>> blocks;
};

// What MemoryPart::owner points at.
struct MemoryBlocks::Owner {
    Block* block = nullptr;
    std::unique_ptr<Block> own;  // The block, where it serves nothing else.
    RangeAllocator::Part* part = nullptr;
};

MemoryBlocks::MemoryBlocks(std::shared_ptr<const DeviceFunctions> vk,
                           const VkPhysicalDeviceMemoryProperties& memory,
                           VkDeviceSize max_allocation_bytes, VkPhysicalDevice budget_of)
    : vk_(std::move(vk)),
      memory_(memory),
      max_allocation_bytes_(max_allocation_bytes),
      budget_of_(budget_of) {}

MemoryBlocks::~MemoryBlocks() = default;

// All types that serve, the best first. Wanted properties are given up one after the other, from the rarest.
std::vector<std::uint32_t> MemoryBlocks::types_for(const MemoryRequest& request) const {
    std::vector<std::uint32_t> types;
    for (VkMemoryPropertyFlags wanted = request.wanted;; wanted &= ~std::bit_floor(wanted)) {
        const VkMemoryPropertyFlags flags = wanted | request.needed;
        for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type)
            if ((request.requirements.memoryTypeBits >> type & 1u) != 0 &&
                (memory_.memoryTypes[type].propertyFlags & flags) == flags &&
                (memory_.memoryTypes[type].propertyFlags & k_special_types) == 0 &&
                std::ranges::find(types, type) == types.end())
                types.push_back(type);
        if (wanted == 0) break;
    }
    if (types.empty())
        throw Error(ErrorCode::no_device, "the device has no memory for " + request.what);
    return types;
}

VkDeviceSize MemoryBlocks::block_limit(std::uint32_t type) const noexcept {
    const VkDeviceSize heap = memory_.memoryHeaps[memory_.memoryTypes[type].heapIndex].size;
    return std::min(
        {k_max_block_bytes, std::max(k_first_block_bytes, heap / 8), max_allocation_bytes_});
}

// What the budget of the type's heap leaves now; everything where there is no budget.
VkDeviceSize MemoryBlocks::free_bytes(std::uint32_t type) const {
    if (budget_of_ == VK_NULL_HANDLE) return ~VkDeviceSize{0};
    return heap_rooms(*vk_, budget_of_, true)[memory_.memoryTypes[type].heapIndex].free_bytes();
}

std::unique_ptr<MemoryBlocks::Block> MemoryBlocks::make_block(const MemoryRequest& request,
                                                              std::uint32_t type, VkDeviceSize size,
                                                              bool dedicated) {
    const auto fail_beyond = [&](VkDeviceSize limit, const char* of) {
        if (size <= limit) return;
        throw Error(ErrorCode::too_large, request.what + " needs " + size_text(size) +
                                              ", more than the device's " + of + " of " +
                                              size_text(limit));
    };
    fail_beyond(max_allocation_bytes_, "maxMemoryAllocationSize");
    fail_beyond(memory_.memoryHeaps[memory_.memoryTypes[type].heapIndex].size, "memory");
    // Lazily allocated memory may take none.
    const bool is_lazy =
        (memory_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT) != 0;
    if (const VkDeviceSize left = free_bytes(type); size > left && !is_lazy)
        throw Error(ErrorCode::too_large,
                    "the device has no memory left for " + request.what + " of " + size_text(size) +
                        ": the system's budget (VK_EXT_memory_budget) leaves " + size_text(left));
    auto block = std::make_unique<Block>(*this, size);
    const VkMemoryDedicatedAllocateInfo owner{
        .sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO,
        .image = request.image,
        .buffer = request.buffer};
    VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                    .pNext = dedicated ? &owner : nullptr};
    if (request.buffer != VK_NULL_HANDLE) flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .pNext = &flags,
                                    .allocationSize = size,
                                    .memoryTypeIndex = type};
    check_room(vk_->AllocateMemory(vk_->device, &info, nullptr, &block->memory), "vkAllocateMemory",
               size, request.what);
    ++allocations_;
    if ((request.needed & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        void* mapped = nullptr;
        check_room(vk_->MapMemory(vk_->device, block->memory, 0, VK_WHOLE_SIZE, 0, &mapped),
                   "vkMapMemory", size, request.what);
        block->mapped = static_cast<std::byte*>(mapped);
    }
    return block;
}

MemoryBlocks::Pool& MemoryBlocks::pool_of(const MemoryRequest& request, std::uint32_t type) {
    const bool for_images = request.image != VK_NULL_HANDLE;
    const bool is_mapped = (request.needed & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
    for (const std::unique_ptr<Pool>& pool : pools_)
        if (pool->type == type && pool->for_images == for_images && pool->is_mapped == is_mapped)
            return *pool;
    return *pools_.emplace_back(std::make_unique<Pool>(
        Pool{.type = type, .for_images = for_images, .is_mapped = is_mapped, .blocks = {}}));
}

MemoryPart MemoryBlocks::allocate(const MemoryRequest& request) {
    const std::vector<std::uint32_t> types = types_for(request);
    std::exception_ptr first_error;  // Names the memory that was wanted.
    for (const std::uint32_t type : types) {
        try {
            return allocate(request, type);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::too_large) throw;
            if (!first_error) first_error = std::current_exception();
        }
    }
    std::rethrow_exception(first_error);
}

MemoryPart MemoryBlocks::allocate(const MemoryRequest& request, std::uint32_t type) {
    const VkDeviceSize size = request.requirements.size;
    auto owner = std::make_unique<Owner>();
    const auto part_of = [&](Block& block, RangeAllocator::Part& part) {
        owner->block = &block;
        owner->part = &part;
        return MemoryPart{.memory = block.memory,
                          .offset = part.offset(),
                          .size = size,
                          .mapped = block.mapped ? block.mapped + part.offset() : nullptr,
                          .owner = owner.release()};
    };
    // Lazily allocated memory is never shared: it may take no memory at all.
    const bool is_lazy =
        (memory_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT) != 0;
    if (size > block_limit(type) / 2 || is_lazy) {
        owner->own = make_block(request, type, size, true);
        return part_of(*owner->own, *owner->own->ranges.allocate(size, 1));
    }
    const std::lock_guard lock(mutex_);
    Pool& pool = pool_of(request, type);
    const VkDeviceSize alignment = request.requirements.alignment;
    for (const std::unique_ptr<Block>& block : pool.blocks)
        if (RangeAllocator::Part* part = block->ranges.allocate(size, alignment))
            return part_of(*block, *part);
    VkDeviceSize block_size =
        std::min(std::max(pool.next_block_bytes, 4 * size), block_limit(type));
    if (block_size > free_bytes(type)) block_size = size;
    pool.blocks.reserve(pool.blocks.size() + 1);
    std::unique_ptr<Block> block = make_block(request, type, block_size, false);
    RangeAllocator::Part* const part = block->ranges.allocate(size, alignment);
    block->pool = &pool;
    pool.next_block_bytes = std::min(2 * block_size, block_limit(type));
    return part_of(*pool.blocks.emplace_back(std::move(block)), *part);
}

void MemoryBlocks::free(const MemoryPart& part) noexcept {
    const std::unique_ptr<Owner> owner(static_cast<Owner*>(part.owner));
    if (!owner || owner->own) return;
    const std::lock_guard lock(mutex_);
    owner->block->ranges.free(*owner->part);
    if (owner->block->ranges.used_size() > 0) return;
    // One that is empty stays.
    auto& blocks = owner->block->pool->blocks;
    const auto is_empty = [](const auto& block) { return block->ranges.used_size() == 0; };
    if (std::ranges::count_if(blocks, is_empty) > 1)
        std::erase_if(blocks, [&](const auto& block) { return block.get() == owner->block; });
}

void MemoryBlocks::trim() noexcept {
    const std::lock_guard lock(mutex_);
    for (const std::unique_ptr<Pool>& pool : pools_) {
        std::erase_if(pool->blocks,
                      [](const auto& block) { return block->ranges.used_size() == 0; });
        if (pool->blocks.empty()) pool->next_block_bytes = k_first_block_bytes;
    }
}

}  // namespace rimline
