#include "engine/tested_device.h"

#include "engine/passes/face_bits_pass.h"

namespace rimline {

TestedDevice::TestedDevice(const VulkanInstance& instance, const DeviceRequest& request,
                           const std::filesystem::path& cache_folder, VkSurfaceKHR surface)
    : Device(instance, request, cache_folder, surface),
      face_bits_agree_(context().round_to_nearest_float32 && test_face_bits(context())) {}

}  // namespace rimline
