#pragma once

// Which device, and why not the others. Separate from Vulkan calls, so that it can be tested on
// machines that do not exist.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rimline {

/// What the choice looks at, read from a physical device by describe_devices() or made up by a test.
struct DeviceFacts {
    std::string name;
    std::string driver;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    std::uint32_t api_version = 0;
    bool geometry_shader = false;
    bool occlusion_query_precise = false;
    bool depth_clamp = false;
    bool buffer_device_address = false;
    bool scalar_block_layout = false;
    bool timeline_semaphore = false;
    bool dynamic_rendering = false;
    bool synchronization2 = false;
    bool maintenance4 = false;
    bool swapchain = false;                 ///< Can show pictures in a window.
    bool round_to_nearest_float32 = false;  ///< RoundingModeRTE can be declared.
    bool graphics_and_compute_queue = false;
    /// Greatest sample count, at most 4, that the color, depth and stencil formats share.
    std::uint32_t samples = 1;
    bool depth_stencil_format = false;  ///< D32S8 can be drawn to and sampled.
};

struct DeviceVerdict {
    /// What it lacks, one phrase each; empty means that Rimline can use it.
    std::vector<std::string> lacks;
    bool usable() const noexcept { return lacks.empty(); }
};

DeviceVerdict judge_device(const DeviceFacts& facts);

/// How a user names a device: "gpu", "cpu", an index below the number of devices, or a part of its
/// name, case ignored; empty takes a discrete GPU if there is one, else an integrated or virtual one,
/// else whatever is usable.
using DeviceRequest = std::string;

struct DeviceChoice {
    std::size_t index;
    /// One line a device: why it was or was not chosen.
    std::vector<std::string> reasons;
};

/// What to say where there is no device at all.
extern const char* const k_no_device_advice;

/// Throws Error{no_device} listing every device with its reason when none fits the request.
DeviceChoice choose_device(std::span<const DeviceFacts> devices, const DeviceRequest& request = {});

/// "discrete GPU", "CPU" and so on.
std::string name_of(VkPhysicalDeviceType type);

}  // namespace rimline
