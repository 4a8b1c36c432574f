#pragma once

// How finely pictures are sampled.

#include <cstdint>

namespace rimline {

struct DeviceContext;

/// The passes draw `scale` x `scale` pixels for each pixel of the picture, with `samples` samples each. Lines
/// have analytic coverage and need one sample: the others are for the edges of surfaces and shadows.
struct Sampling {
    std::uint32_t samples = 1;
    std::uint32_t scale = 1;
    bool operator==(const Sampling&) const = default;
};

/// The most samples that the passes take.
constexpr std::uint32_t k_max_samples = 8;

/// What is asked for, where the device has it: the greatest sample count up to `samples` and k_max_samples that it
/// supports for all attachments. It is 1 where samples are not at Vulkan's standard locations
/// (standardSampleLocations), because lines are compared with the depth of the first one. 0 stands for the device's
/// default: 4 samples at scale 1 for GPUs, which resolve samples in hardware and shade each pixel once; 1 sample at
/// scale 2 for devices of the CPU type, which pay for every sample as for a pixel (docs/results/engine.md has the times
/// and the difference), and for those without standard locations.
Sampling sampling_of(const DeviceContext& context, std::uint32_t samples, std::uint32_t scale);

}  // namespace rimline
