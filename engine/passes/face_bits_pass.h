#pragma once

// Face bits computed on the GPU from planes, by shaders/face_bit.glsl.
//
// Drawing does not need them, because bits are streamed from the CPU. The pass tests that the GPU computes
// the same bits as the CPU (tested_device.h).

#include <cstdint>
#include <span>
#include <vector>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/pipeline.h"
#include "silhouette/mesh/plane.h"

namespace rimline {

class FaceBitsPass {
public:
    /// Throws Error{no_device} if the device lacks RoundingModeRTE for 32-bit floats.
    explicit FaceBitsPass(const DeviceContext& context);

    /// The face bits of `planes` from `point`, packed as in silhouette/mesh/face_bits.h. Uploads, computes,
    /// reads back, and waits.
    std::vector<std::uint32_t> compute(std::span<const Plane> planes,
                                       const HomogeneousPoint& point);

private:
    DeviceContext context_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

/// Whether the device's bits equal the CPU's on planes whose sign depends on the last bit, so that contracted
/// products, reordered sums and wrong rounding are detected. Waits.
bool test_face_bits(const DeviceContext& context);

}  // namespace rimline
