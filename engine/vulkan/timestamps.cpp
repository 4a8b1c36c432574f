#include "engine/vulkan/timestamps.h"

#include <vector>

#include "engine/vulkan/functions.h"

namespace rimline {

TimestampUnit timestamp_unit(const DeviceContext& context) {
    std::uint32_t count = 0;
    context.vk->GetPhysicalDeviceQueueFamilyProperties(context.physical_device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    context.vk->GetPhysicalDeviceQueueFamilyProperties(context.physical_device, &count,
                                                       families.data());
    return {families.at(context.queue_family).timestampValidBits,
            double{context.limits.timestampPeriod} * 1e-6};
}

}  // namespace rimline
