#pragma once

// A logical device with the queue that everything runs on, and one beside it for copies where there is one.

#include <vulkan/vulkan.h>

#include <functional>
#include <string>
#include <vector>

#include "engine/vulkan/device_choice.h"
#include "engine/vulkan/vulkan_handle.h"
#include "engine/vulkan/vulkan_instance.h"

namespace rimline {

/// Of every depth attachment: reversed depth needs floats.
constexpr VkFormat k_depth_stencil_format = VK_FORMAT_D32_SFLOAT_S8_UINT;

/// What a device may have beyond what judge_device() asks for. Each is true only where it was enabled
/// when the device was opened; passes choose their way by it.
struct DeviceFeatures {
    bool geometry_shader = false;
    bool swapchain = false;  ///< Only asked for of an instance that presents.
    bool occlusion_query_precise = false;
};

/// What the passes need of a device: ours or a caller's. The caller keeps everything alive, and has
/// enabled what judge_device() asks for.
struct DeviceContext {
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    /// For copies into static buffers (uploads.h): of another family, or the queue above.
    VkQueue transfer_queue = VK_NULL_HANDLE;
    std::uint32_t transfer_family = 0;
    VkPhysicalDeviceMemoryProperties memory{};
    VkPhysicalDeviceLimits limits{};
    /// maxBufferSize and maxMemoryAllocationSize.
    VkDeviceSize max_buffer_bytes = ~VkDeviceSize{0};
    VkDeviceSize max_allocation_bytes = ~VkDeviceSize{0};
    DeviceFeatures features{};
    std::uint32_t samples = 1;  ///< Greatest sample count, at most 4, of all attachments.
};

/// Every physical device of an instance, usable or not, in Vulkan's order.
std::vector<DeviceFacts> describe_devices(const VulkanInstance& instance);

/// Reads a context from handles a caller made; `features` are those the caller enabled. One queue does
/// for everything; who has one for copies to spare sets transfer_queue and transfer_family afterwards.
DeviceContext make_device_context(VkPhysicalDevice physical_device, VkDevice device, VkQueue queue,
                                  std::uint32_t queue_family, const DeviceFeatures& features);

class Device {
public:
    /// Chooses, opens and tests a device. `instance` must outlive it.
    /// Throws Error{no_device} when none fits `request` (device_choice.h) or can be opened, and
    /// Error{too_large} or Error{device_lost} when that fails for want of memory or of the device.
    explicit Device(const VulkanInstance& instance, const DeviceRequest& request = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceContext& context() const noexcept { return context_; }
    const DeviceFacts& facts() const noexcept { return facts_; }

    /// Whether the device's face bits agreed with the CPU's on the known-answer test when it was
    /// opened. Bits that are drawn with come from the CPU either way.
    bool face_bits_agree() const noexcept { return face_bits_agree_; }

private:
    DeviceContext context_;
    DeviceFacts facts_;
    bool face_bits_agree_ = false;
};

/// A timeline semaphore at 0.
OwnedSemaphore make_timeline(const DeviceContext& context);
/// Waits until `timeline` reaches `value`. Throws what vk_check() does.
void wait_for_timeline(const DeviceContext& context, VkSemaphore timeline, std::uint64_t value);
/// For a queue of `family`; its buffers can be reset one by one.
OwnedCommandPool make_command_pool(const DeviceContext& context, std::uint32_t family);
/// A command buffer of `pool`, begun, to be submitted once. It goes with the pool.
VkCommandBuffer begin_commands(const DeviceContext& context, VkCommandPool pool);

/// Records commands, submits them, and waits until they are done. For setting up, not for frames.
/// Throws what vk_check() does; what the commands use may be freed then.
void run_commands(const DeviceContext& context, const std::function<void(VkCommandBuffer)>& record);

}  // namespace rimline
