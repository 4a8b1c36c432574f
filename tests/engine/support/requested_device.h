#pragma once

// The device that tests run on: that of the variable RIMLINE_DEVICE, as --device names one, else the default.
// Tests of the program need nothing for it: its option --device reads the same variable.

#include <cstdlib>

#include "engine/vulkan/device_choice.h"

namespace rimline::tests {

/// Empty: the default device.
inline DeviceRequest requested_device() {
    const char* const request = std::getenv("RIMLINE_DEVICE");
    return request == nullptr ? DeviceRequest() : DeviceRequest(request);
}

}  // namespace rimline::tests
