#pragma once

// Where the memory of buffers and images comes from: an interface, so that a caller's allocator can serve
// (HostDevice::allocator), and Rimline's own allocator, MemoryBlocks (memory_blocks.h).

#include <vulkan/vulkan.h>

#include <cstddef>
#include <string>

namespace rimline {

struct MemoryRequest {
    VkMemoryRequirements requirements{};
    /// Needed properties; and those that it should have besides, where a type has them.
    VkMemoryPropertyFlags needed = 0;
    VkMemoryPropertyFlags wanted = 0;
    /// Of the two one is not null: what the memory is for, not yet bound. Buffers have device addresses.
    VkBuffer buffer = VK_NULL_HANDLE;
    VkImage image = VK_NULL_HANDLE;
    std::string what;  ///< For messages: "positions".
};

/// A part of a VkDeviceMemory.
struct MemoryPart {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr;  ///< Of its first byte; null where HOST_VISIBLE was not needed.
    void* owner = nullptr;        ///< The allocator's own.
};

/// All functions may be called by any thread.
class MemoryAllocator {
public:
    virtual ~MemoryAllocator() = default;
    /// Memory needed to be HOST_VISIBLE is mapped while it lives. Throws Error{too_large} naming `what` where
    /// memory has run out, and Error{no_device} where no type of memory fits.
    virtual MemoryPart allocate(const MemoryRequest& request) = 0;
    virtual void free(const MemoryPart& part) noexcept = 0;
};

}  // namespace rimline
