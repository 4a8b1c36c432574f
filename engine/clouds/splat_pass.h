#pragma once

// Point clouds: discs that hide one another by depth, and lines over them.
//
// A disc lies in the plane of its point's normal. Discs as wide as the distance between points close to a
// surface, which hides everything behind it. The edge of a disc lies a little behind its center, so that
// where discs overlap the one of the nearest point is visible. Lines are tested against the same depth. Their
// ends lie on the surface, which discs only approximate, so lines are moved towards the camera by the
// distance that discs may protrude (splat_layout.h).

#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"
#include "shaders/splat_layout.h"

namespace rimline {

class SplatPass {
public:
    SplatPass(const DeviceContext& context, const AttachmentFormats& formats);

    /// Draws so many records of each kind, at the addresses in `constants`. Inside a rendering scope with
    /// cleared attachments. Writes color and depth.
    void record(Commands commands, const gpu::SplatConstants& constants, std::uint32_t splat_count,
                std::uint32_t stroke_count) const;

private:
    OwnedPipelineLayout layout_;
    OwnedPipeline splats_;
    OwnedPipeline strokes_;
};

}  // namespace rimline
