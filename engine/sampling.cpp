#include "engine/sampling.h"

#include "engine/vulkan/device_context.h"

namespace rimline {

Sampling sampling_of(const DeviceContext& context, std::uint32_t samples, std::uint32_t scale) {
    const bool is_cpu = context.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    Sampling sampling{.samples = samples, .scale = scale};
    const bool takes_samples = !is_cpu && context.limits.standardSampleLocations == VK_TRUE;
    if (samples == 0) sampling.samples = takes_samples ? 4 : 1;
    if (scale == 0) sampling.scale = takes_samples ? 1 : 2;
    // Vulkan's flags have the counts' values. Every device has 1.
    const auto fits = [&](std::uint32_t count) {
        return count == 1 || (count <= sampling.samples && (context.sample_counts & count) != 0 &&
                              context.limits.standardSampleLocations == VK_TRUE);
    };
    std::uint32_t count = k_max_samples;
    while (!fits(count)) count /= 2;
    sampling.samples = count;
    return sampling;
}

}  // namespace rimline
