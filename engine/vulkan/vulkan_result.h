#pragma once

// Vulkan's results as errors.

#include <vulkan/vulkan.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

/// The name of a result as Vulkan writes it: "VK_ERROR_DEVICE_LOST".
std::string name_of(VkResult result);

/// Whether memory, address space, a pool or the number of objects has run out. A later call may succeed.
bool is_out_of_memory(VkResult result) noexcept;

/// The error of a failed `call`: device_lost if the device is lost, too_large if memory has run out, and
/// no_device for other results, which a device that judge_device() accepts does not return.
Error error_of(VkResult result, const std::string& call);

/// Throws error_of() unless `result` is VK_SUCCESS. For calls without other success codes.
inline void vk_check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) throw error_of(result, call);
}

/// All items of a vkEnumerate function, called as call(&count, items). With null items it counts them. The
/// list may grow between the two calls (VK_INCOMPLETE); then both are repeated.
template <typename Item, typename Call>
std::vector<Item> enumerate(Call&& call, const char* name) {
    std::vector<Item> items;
    VkResult result = VK_INCOMPLETE;
    while (result == VK_INCOMPLETE) {
        std::uint32_t count = 0;
        vk_check(call(&count, nullptr), name);
        items.resize(count);
        result = call(&count, items.data());
        items.resize(std::min<std::size_t>(count, items.size()));
    }
    vk_check(result, name);
    return items;
}

/// Repeats `wait`, for about a second, while it fails because memory has run out: the objects it waits for
/// are still in use and must not be freed before the wait succeeds. Returns the last result.
template <typename Wait>
VkResult repeat_wait(Wait&& wait) {
    constexpr int k_max_repetitions = 1000;  // Of 1 ms.
    VkResult result = wait();
    for (int i = 0; is_out_of_memory(result) && i < k_max_repetitions; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        result = wait();
    }
    return result;
}

}  // namespace rimline
