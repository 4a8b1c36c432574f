#pragma once

// A Device that has passed through a known-answer test: face bits computed on it are compared with the
// CPU's (face_bits_pass.h). Bits that are drawn with come from the CPU either way.

#include "engine/vulkan/device.h"

namespace rimline {

class TestedDevice : public Device {
public:
    /// Opens a device as Device does, and tests it. Throws as Device, and Error{too_large} or
    /// Error{device_lost} where the test runs out of memory or loses the device.
    explicit TestedDevice(const VulkanInstance& instance, const DeviceRequest& request = {},
                          const std::filesystem::path& cache_folder = {},
                          VkSurfaceKHR surface = VK_NULL_HANDLE);

    /// Whether the device's face bits equal the CPU's. False too where it cannot compute them
    /// (DeviceContext::round_to_nearest_float32).
    bool face_bits_agree() const noexcept { return face_bits_agree_; }

private:
    bool face_bits_agree_;
};

}  // namespace rimline
