#pragma once

// The choice of a device, with a reason for each that was not chosen. Separate from Vulkan calls, so that it
// can be tested with made-up devices.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rimline {

/// The facts that the choice depends on: from describe_devices() or describe_device() (device.h), or made up by a test.
struct DeviceFacts {
    std::string name;
    std::string driver;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    std::uint32_t api_version = 0;
    bool geometry_shader = false;
    bool occlusion_query_precise = false;
    bool depth_clamp = false;
    bool depth_bounds = false;
    bool buffer_device_address = false;
    bool scalar_block_layout = false;
    bool timeline_semaphore = false;
    bool dynamic_rendering = false;
    bool synchronization2 = false;
    bool maintenance4 = false;
    bool swapchain = false;  ///< Can show pictures in some window.
    /// Can show pictures in the window that the device is wanted for: it has `swapchain`, and a queue that draws,
    /// computes and presents to the window's surface. std::nullopt: it is wanted for no window.
    std::optional<bool> shows_window;
    bool memory_budget = false;          ///< VK_EXT_memory_budget.
    bool conditional_rendering = false;  ///< VK_EXT_conditional_rendering.
    /// RoundingModeRTE can be declared. Meshes that deform need it (Scene), and nothing else does.
    bool round_to_nearest_float32 = false;
    bool graphics_and_compute_queue = false;
    bool depth_stencil_format = false;  ///< D32S8 can be drawn to and sampled.
};

struct DeviceVerdict {
    /// The requirements it lacks, one phrase each. Empty: Rimline can use the device.
    std::vector<std::string> lacks;
    bool usable() const noexcept { return lacks.empty(); }
};

DeviceVerdict judge_device(const DeviceFacts& facts);

/// How a user names a device: "gpu", "cpu", an index below the number of devices, or a part of its name, case
/// ignored. Empty: a discrete GPU if there is one, else an integrated or virtual one, else any usable device.
using DeviceRequest = std::string;

struct DeviceChoice {
    std::size_t index;
    /// One line for each device: why it was or was not chosen.
    std::vector<std::string> reasons;
};

/// The advice for a machine without any device.
extern const char* const k_no_device_advice;

/// Throws Error{no_device}, which lists every device with its reason, if none fits the request.
DeviceChoice choose_device(std::span<const DeviceFacts> devices, const DeviceRequest& request = {});

/// "discrete GPU", "CPU" and so on.
std::string name_of(VkPhysicalDeviceType type);

}  // namespace rimline
