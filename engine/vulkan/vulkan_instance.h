#pragma once

// The Vulkan instance, optionally with validation. Validation messages are counted, so that a test or the
// command can check that there are none.

#include <vulkan/vulkan.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rimline {

struct InstanceFunctions;

struct InstanceOptions {
    /// Turns on the validation layer with synchronization checks. Missing layers are an error.
    bool validate = false;
    /// Where Vulkan's functions come from: the vkGetInstanceProcAddr of a loader, which must outlive the
    /// instance. Null: the system's loader.
    PFN_vkGetInstanceProcAddr loader = nullptr;
    /// Instance extensions that a window system needs. If there are any, devices are opened for presenting.
    std::vector<std::string> window_extensions;
};

class VulkanInstance {
public:
    /// Throws Error{no_device} if there is no Vulkan 1.3 loader, or if the requested validation layer is
    /// missing.
    explicit VulkanInstance(const InstanceOptions& options = {});
    ~VulkanInstance();
    VulkanInstance(const VulkanInstance&) = delete;
    VulkanInstance& operator=(const VulkanInstance&) = delete;

    VkInstance handle() const noexcept { return instance_; }
    const InstanceFunctions& functions() const noexcept { return *functions_; }
    PFN_vkGetInstanceProcAddr loader() const noexcept { return loader_; }
    bool validates() const noexcept { return messenger_ != VK_NULL_HANDLE; }
    /// Whether it was made with the extensions of a window system.
    bool presents() const noexcept { return presents_; }

    /// Whether VK_EXT_debug_utils is enabled: where the loader or a layer has it.
    bool has_debug_utils() const noexcept { return has_debug_utils_; }

    /// The number of warnings and errors of the validation layer so far; std::nullopt if it is off. Any
    /// thread.
    std::optional<std::uint32_t> validation_message_count() const noexcept;
    /// The first of these messages; empty if there were none.
    std::string first_validation_message() const;

private:
    struct Messages;

    PFN_vkGetInstanceProcAddr loader_;
    std::unique_ptr<InstanceFunctions> functions_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool presents_;
    bool has_debug_utils_ = false;
    std::unique_ptr<Messages> messages_;  // Its address is the messenger's user data.
};

}  // namespace rimline
