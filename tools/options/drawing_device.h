#pragma once

// The device that a subcommand draws on, and what it says about it afterwards.

#include <nlohmann/json_fwd.hpp>

#include "engine/tested_device.h"
#include "engine/vulkan/vulkan_instance.h"
#include "tools/options/picture_options.h"

namespace rimline::tools {

struct DrawingDevice {
    /// As --device and --validate say. Throws Error{no_device}.
    explicit DrawingDevice(const PictureOptions& options)
        : instance({.validate = options.validate}), device(instance, options.device) {}

    const DeviceContext& context() const noexcept { return device.context(); }

    VulkanInstance instance;
    TestedDevice device;
};

/// `device driver validation_messages`: the last null unless layers were on, all of them where nothing
/// was drawn, which is null here.
nlohmann::ordered_json device_json(const DrawingDevice* drawn);
/// A line on what layers found, where they were on.
void print_validation(const DrawingDevice& drawn);

}  // namespace rimline::tools
