#pragma once

// Vulkan's results become errors, its handles move-only owners.

#include <vulkan/vulkan.h>

#include <string>
#include <utility>

#include "silhouette/error.h"

namespace rimline {

/// The name of a result as Vulkan writes it: "VK_ERROR_DEVICE_LOST".
std::string name_of(VkResult result);

/// Throws Error{no_device} naming `call` unless `result` is VK_SUCCESS.
inline void vk_check(VkResult result, const char* call) {
    if (result != VK_SUCCESS)
        throw Error(ErrorCode::no_device, std::string(call) + " failed with " + name_of(result));
}

/// Owns one object of a device: `destroy` is its vkDestroy function. The device must outlive it.
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
using OwnedCommandPool = DeviceHandle<VkCommandPool, vkDestroyCommandPool>;

}  // namespace rimline
