#pragma once

// What a caller's submission waits for before it reads what was uploaded.

#include <vulkan/vulkan.h>

#include <cstdint>

namespace rimline {

/// A value of a timeline semaphore. A submission that waits for it, as
///     VkSemaphoreSubmitInfo{.semaphore = point.timeline, .value = point.value, .stageMask = ...}
/// sees the copies that were sent before.
struct UploadPoint {
    VkSemaphore timeline = VK_NULL_HANDLE;
    std::uint64_t value = 0;  ///< 0: there is nothing to wait for.
};

}  // namespace rimline
