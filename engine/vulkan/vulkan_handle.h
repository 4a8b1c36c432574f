#pragma once

// Vulkan's handles as move-only owners.

#include <vulkan/vulkan.h>

#include <utility>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/vulkan_result.h"

namespace rimline {

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
using OwnedShaderModule = DeviceHandle<VkShaderModule, &DeviceFunctions::DestroyShaderModule>;
using OwnedPipeline = DeviceHandle<VkPipeline, &DeviceFunctions::DestroyPipeline>;
using OwnedPipelineCache = DeviceHandle<VkPipelineCache, &DeviceFunctions::DestroyPipelineCache>;
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
