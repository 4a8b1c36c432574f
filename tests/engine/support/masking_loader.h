#pragma once

// A loader that makes the machine's devices look like others: with a property masked, an extension added, or other
// answers about windows and memory.

#include <vulkan/vulkan.h>

#include <optional>
#include <string>
#include <vector>

namespace rimline::tests {

/// What is changed. Everything else is the machine's.
struct Mask {
    bool round_to_nearest = true;  ///< False: shaderRoundingModeRTEFloat32 is false.
    /// Whether queues can present to any surface; the surfaces need not exist.
    std::optional<bool> presents;
    /// With a value, devices have VK_EXT_memory_budget with this budget of each heap, of which nothing is used.
    std::optional<VkDeviceSize> budget_bytes;
};

/// One test at a time: sets what masking_loader() changes while it lives.
class Masked {
public:
    explicit Masked(const Mask& mask);
    ~Masked();
    Masked(const Masked&) = delete;
    Masked& operator=(const Masked&) = delete;

    /// Changes the budget; for a mask that has one.
    void set_budget(VkDeviceSize bytes);
    /// Names of the extensions that the device opened last was opened with.
    const std::vector<std::string>& opened_with() const;
};

/// For InstanceOptions::loader.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL masking_loader(VkInstance instance, const char* name);

}  // namespace rimline::tests
