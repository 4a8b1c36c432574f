#include "engine/tested_device.h"

#include "engine/passes/face_bits_pass.h"

namespace rimline {

TestedDevice::TestedDevice(const VulkanInstance& instance, const DeviceRequest& request,
                           const std::filesystem::path& cache_folder)
    : Device(instance, request, cache_folder), face_bits_agree_(test_face_bits(context())) {}

}  // namespace rimline
