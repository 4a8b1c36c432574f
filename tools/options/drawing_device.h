#pragma once

// The device that a subcommand draws on, and its part of the output.

#include <nlohmann/json_fwd.hpp>

#include "engine/tested_device.h"
#include "engine/vulkan/vulkan_instance.h"
#include "tools/options/cache_folder.h"
#include "tools/options/picture_options.h"

namespace rimline::tools {

struct DrawingDevice {
    /// Opens the device of --device and --validate. Throws Error{no_device}.
    explicit DrawingDevice(const PictureOptions& options)
        : instance({.validate = options.validate}),
          device(instance, options.device, user_cache_folder()) {}

    const DeviceContext& context() const noexcept { return device.context(); }

    VulkanInstance instance;
    TestedDevice device;
};

/// `device driver validation_messages`. The last one is null without validation layers. All three are null
/// if `device` is null.
nlohmann::ordered_json device_json(const DrawingDevice* device);
/// Prints one line with the number of validation messages. Prints nothing without validation layers.
void print_validation(const DrawingDevice& device);

}  // namespace rimline::tools
