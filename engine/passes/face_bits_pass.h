#pragma once

// Face bits computed on the GPU from planes, by shaders/face_bit.glsl.
//
// Drawing does not need it, for bits are streamed from the CPU; it is the proof that both sides decide
// alike, run on known answers whenever a device is opened.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/vulkan/device.h"
#include "engine/vulkan/pipeline.h"
#include "silhouette/mesh/plane.h"

namespace rimline {

class FaceBitsPass {
public:
    explicit FaceBitsPass(const DeviceContext& context);

    /// The face bits of `planes` from `point`, packed as silhouette/mesh/face_bits.h says. Uploads,
    /// runs and reads back; waits.
    std::vector<std::uint32_t> compute(std::span<const Plane> planes,
                                       const HomogeneousPoint& point);

private:
    DeviceContext context_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

/// Whether the device's bits equal the CPU's on planes chosen to catch contraction, reordered sums and
/// wrong rounding: near-degenerate sides whose sign hangs on the last bit.
bool test_face_bits(const DeviceContext& context);

}  // namespace rimline
