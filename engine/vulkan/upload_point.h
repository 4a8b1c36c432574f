#pragma once

// What a caller's submission waits for before it reads what was uploaded.

#include <vulkan/vulkan.h>

#include <cstdint>

namespace rimline {

/// A value of a timeline semaphore. A submission that waits for it, as
///     VkSemaphoreSubmitInfo{.semaphore = point.timeline, .value = point.value,
///                           .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}
/// sees the copies that were sent before. Fewer stages do not suffice: compute shaders, index input and shaders of all
/// kinds read what was copied.
struct UploadPoint {
    VkSemaphore timeline = VK_NULL_HANDLE;
    std::uint64_t value = 0;  ///< 0: there is nothing to wait for, and the wait may be left out.
};

}  // namespace rimline
