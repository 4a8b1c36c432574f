#pragma once

// Vulkan's results become errors, its handles move-only owners.

#include <vulkan/vulkan.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

/// The name of a result as Vulkan writes it: "VK_ERROR_DEVICE_LOST".
std::string name_of(VkResult result);

/// Whether memory, address space, a pool or a number of objects has run out: the same call may do later.
bool is_out_of_memory(VkResult result) noexcept;

/// What a failed `call` throws: device_lost where the device is, too_large where memory has run out, and
/// no_device for all else, which a machine that judge_device() found usable does not answer.
Error error_of(VkResult result, const std::string& call);

/// Throws error_of() unless `result` is VK_SUCCESS. Calls with another good answer look at it first.
inline void vk_check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) throw error_of(result, call);
}

/// All that a vkEnumerate function lists, called as call(&count, items): with null items it counts. The
/// list may grow between the two calls (VK_INCOMPLETE); then both are made again.
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

/// Calls `wait` again, for about a second, while it fails for want of memory: what it waits for is still
/// in use, and nobody may free it because the wait could not be made. Returns its last answer.
template <typename Wait>
VkResult repeat_wait(Wait&& wait) {
    constexpr int k_max_repetitions = 1000;
    VkResult result = wait();
    for (int i = 0; is_out_of_memory(result) && i < k_max_repetitions; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        result = wait();
    }
    return result;
}

/// Owns one object of a device: `destroy` is its vkDestroy function. The device must outlive it; it may
/// be lost.
template <typename Handle, auto destroy>
class DeviceHandle {
public:
    DeviceHandle() = default;
    DeviceHandle(VkDevice device, Handle handle) noexcept : device_(device), handle_(handle) {}
    DeviceHandle(DeviceHandle&& other) noexcept
        : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
    DeviceHandle& operator=(DeviceHandle&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~DeviceHandle() {
        if (handle_ != VK_NULL_HANDLE) destroy(device_, handle_, nullptr);
    }

    Handle get() const noexcept { return handle_; }
    operator Handle() const noexcept { return handle_; }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
};

using OwnedBuffer = DeviceHandle<VkBuffer, vkDestroyBuffer>;
using OwnedImage = DeviceHandle<VkImage, vkDestroyImage>;
using OwnedImageView = DeviceHandle<VkImageView, vkDestroyImageView>;
using OwnedMemory = DeviceHandle<VkDeviceMemory, vkFreeMemory>;
using OwnedShaderModule = DeviceHandle<VkShaderModule, vkDestroyShaderModule>;
using OwnedPipeline = DeviceHandle<VkPipeline, vkDestroyPipeline>;
using OwnedPipelineLayout = DeviceHandle<VkPipelineLayout, vkDestroyPipelineLayout>;
using OwnedDescriptorSetLayout = DeviceHandle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using OwnedDescriptorPool = DeviceHandle<VkDescriptorPool, vkDestroyDescriptorPool>;
using OwnedSampler = DeviceHandle<VkSampler, vkDestroySampler>;
using OwnedSemaphore = DeviceHandle<VkSemaphore, vkDestroySemaphore>;
using OwnedFence = DeviceHandle<VkFence, vkDestroyFence>;
using OwnedSwapchain = DeviceHandle<VkSwapchainKHR, vkDestroySwapchainKHR>;
using OwnedQueryPool = DeviceHandle<VkQueryPool, vkDestroyQueryPool>;
using OwnedCommandPool = DeviceHandle<VkCommandPool, vkDestroyCommandPool>;

}  // namespace rimline
