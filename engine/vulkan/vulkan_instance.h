#pragma once

// The Vulkan instance, with validation when asked: messages are counted, so that a test or the command
// can demand silence.

#include <vulkan/vulkan.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rimline {

struct InstanceOptions {
    /// Turns on the validation layer with synchronization checks. Missing layers are an error.
    bool validate = false;
    /// Instance extensions that a window system needs; with any, devices are opened for presenting.
    std::vector<std::string> window_extensions;
};

class VulkanInstance {
public:
    /// Throws Error{no_device} where there is no Vulkan 1.3 loader, or no validation layer when asked.
    explicit VulkanInstance(const InstanceOptions& options = {});
    ~VulkanInstance();
    VulkanInstance(const VulkanInstance&) = delete;
    VulkanInstance& operator=(const VulkanInstance&) = delete;

    VkInstance handle() const noexcept { return instance_; }
    bool validates() const noexcept { return messenger_ != VK_NULL_HANDLE; }
    /// Whether it was made with the extensions of a window system.
    bool presents() const noexcept { return presents_; }

    /// Warnings and errors of the validation layer so far; nothing where it is off. Any thread.
    std::optional<std::uint32_t> validation_message_count() const noexcept;
    /// The first of them, to tell what went wrong; empty when there were none.
    std::string first_validation_message() const;

private:
    struct Messages;

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool presents_;
    std::unique_ptr<Messages> messages_;  // Its address is the messenger's user data.
};

}  // namespace rimline
