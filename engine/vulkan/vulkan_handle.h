#pragma once

// Vulkan's results as errors, and its handles as move-only owners.

#include <vulkan/vulkan.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/vulkan/device.h"
#include "engine/vulkan/functions.h"
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

/// Owns one object of a device. `destroy` is its function. The context that it was made with must outlive the
/// owner; the device may be lost.
template <typename Handle, auto destroy>
class DeviceHandle {
public:
    DeviceHandle() = default;
    DeviceHandle(const DeviceContext& context, Handle handle) noexcept
        : vk_(context.vk.get()), handle_(handle) {}
    DeviceHandle(DeviceHandle&& other) noexcept
        : vk_(other.vk_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
    DeviceHandle& operator=(DeviceHandle&& other) noexcept {
        std::swap(vk_, other.vk_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~DeviceHandle() {
        if (handle_ != VK_NULL_HANDLE) (vk_->*destroy)(vk_->device, handle_, nullptr);
    }

    Handle get() const noexcept { return handle_; }
    operator Handle() const noexcept { return handle_; }

private:
    const DeviceFunctions* vk_ = nullptr;
    Handle handle_ = VK_NULL_HANDLE;
};

using OwnedBuffer = DeviceHandle<VkBuffer, &DeviceFunctions::DestroyBuffer>;
using OwnedImage = DeviceHandle<VkImage, &DeviceFunctions::DestroyImage>;
using OwnedImageView = DeviceHandle<VkImageView, &DeviceFunctions::DestroyImageView>;
using OwnedMemory = DeviceHandle<VkDeviceMemory, &DeviceFunctions::FreeMemory>;
using OwnedShaderModule = DeviceHandle<VkShaderModule, &DeviceFunctions::DestroyShaderModule>;
using OwnedPipeline = DeviceHandle<VkPipeline, &DeviceFunctions::DestroyPipeline>;
using OwnedPipelineLayout = DeviceHandle<VkPipelineLayout, &DeviceFunctions::DestroyPipelineLayout>;
using OwnedDescriptorSetLayout =
    DeviceHandle<VkDescriptorSetLayout, &DeviceFunctions::DestroyDescriptorSetLayout>;
using OwnedDescriptorPool = DeviceHandle<VkDescriptorPool, &DeviceFunctions::DestroyDescriptorPool>;
using OwnedSampler = DeviceHandle<VkSampler, &DeviceFunctions::DestroySampler>;
using OwnedSemaphore = DeviceHandle<VkSemaphore, &DeviceFunctions::DestroySemaphore>;
using OwnedFence = DeviceHandle<VkFence, &DeviceFunctions::DestroyFence>;
using OwnedSwapchain = DeviceHandle<VkSwapchainKHR, &DeviceFunctions::DestroySwapchainKHR>;
using OwnedQueryPool = DeviceHandle<VkQueryPool, &DeviceFunctions::DestroyQueryPool>;
using OwnedCommandPool = DeviceHandle<VkCommandPool, &DeviceFunctions::DestroyCommandPool>;

}  // namespace rimline
