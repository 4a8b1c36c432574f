#pragma once

// A logical device, with one queue for drawing and computing, and a second one for copies if there is one.

#include <vulkan/vulkan.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "engine/vulkan/device_choice.h"
#include "engine/vulkan/device_context.h"
#include "engine/vulkan/vulkan_instance.h"

namespace rimline {

class PipelineCache;
struct QueueChoice;

/// Every physical device of an instance, usable or not, in Vulkan's order. With a surface, which the instance
/// presents to: DeviceFacts::shows_window says whether each can show pictures there. Throws what vk_check() does.
std::vector<DeviceFacts> describe_devices(const VulkanInstance& instance,
                                          VkSurfaceKHR surface = VK_NULL_HANDLE);

/// A physical device of a caller's instance, for judge_device(). `loader` as in HostDevice. Throws Error{no_device}
/// naming a function that the loader or the driver lacks.
DeviceFacts describe_device(VkInstance instance, VkPhysicalDevice device,
                            PFN_vkGetInstanceProcAddr loader = nullptr);

class Device {
public:
    /// Chooses and opens a device. `instance` must outlive it. Throws Error{no_device} if none fits `request`
    /// (device_choice.h) or none can be opened, Error{too_large} if memory runs out, and Error{device_lost}
    /// if the device is lost. Compiled pipelines are kept in `cache_folder` (pipeline_cache.h); empty: nowhere.
    /// With a surface: only a device that can show pictures there is chosen, and its queue presents to it.
    explicit Device(const VulkanInstance& instance, const DeviceRequest& request = {},
                    const std::filesystem::path& cache_folder = {},
                    VkSurfaceKHR surface = VK_NULL_HANDLE);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceContext& context() const noexcept { return context_; }
    const DeviceFacts& facts() const noexcept { return facts_; }

private:
    void open_queues(const VulkanInstance& instance, VkDevice device, VkPhysicalDevice physical,
                     const QueueChoice& queues, bool presents);

    DeviceContext context_;
    DeviceFacts facts_;
    std::unique_ptr<PipelineCache> pipeline_cache_;
};

}  // namespace rimline
