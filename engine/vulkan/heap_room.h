#pragma once

// How much memory the heaps of a device have left for this program, as the system says (VK_EXT_memory_budget).

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

#include "engine/vulkan/functions.h"

namespace rimline {

/// One heap. Budget and use are the driver's estimates and change with what other programs do.
struct HeapRoom {
    VkDeviceSize size_bytes = 0;
    VkDeviceSize budget_bytes =
        0;  ///< What this program may use in all. Without the extension: the size.
    VkDeviceSize used_bytes = 0;  ///< What it uses now. Without the extension: 0.
    bool is_device_local = false;

    VkDeviceSize free_bytes() const noexcept {
        return budget_bytes > used_bytes ? budget_bytes - used_bytes : 0;
    }
};

/// Every heap, in Vulkan's order. One call of the driver. `has_budget`: the device has the extension, as
/// DeviceFeatures::memory_budget says.
std::vector<HeapRoom> heap_rooms(const InstanceFunctions& vk, VkPhysicalDevice device,
                                 bool has_budget);

}  // namespace rimline
