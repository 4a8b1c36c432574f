#pragma once

// Point clouds: discs that hide one another by depth, and lines over them.
//
// A disc lies in the plane of its point's normal, so that discs as wide as the cloud is dense close to a
// surface, and what lies behind it is hidden; its edge lies a little behind its middle, so that of discs
// that overlap the nearest point's is seen. Lines are tested against the same
// depth. Their ends lie on the surface that the discs only approximate: they are moved towards the
// camera by what discs may stand out (splat_layout.h).

#include "engine/vulkan/pipeline.h"
#include "shaders/splat_layout.h"

namespace rimline {

class SplatPass {
public:
    SplatPass(const DeviceContext& context, const AttachmentFormats& formats);

    /// So many records of each kind, at the addresses in `constants`. Inside a rendering scope with
    /// cleared attachments; writes color and depth.
    void record(VkCommandBuffer commands, const gpu::SplatConstants& constants,
                std::uint32_t splat_count, std::uint32_t stroke_count) const;

private:
    OwnedPipelineLayout layout_;
    OwnedPipeline splats_;
    OwnedPipeline strokes_;
};

}  // namespace rimline
