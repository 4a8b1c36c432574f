#include "engine/tested_device.h"

#include "engine/passes/face_bits_pass.h"

namespace rimline {

TestedDevice::TestedDevice(const VulkanInstance& instance, const DeviceRequest& request)
    : Device(instance, request), face_bits_agree_(test_face_bits(context())) {}

}  // namespace rimline
