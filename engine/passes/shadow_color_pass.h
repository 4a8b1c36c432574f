#pragma once

// The color of shadows, in a frame with one light: where the stencil is not zero, what surfaces show in its shadow,
// from an image that was drawn with the surfaces (SurfaceLights::beside_shadow). So the faces are drawn once. On
// lavapipe a second draw of 70,000 faces, for what the light adds, took a third of a small picture's time.

#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/sampled_images.h"

namespace rimline {

class ShadowColorPass {
public:
    /// Draws into attachments of `formats`, one sample a pixel.
    ShadowColorPass(const DeviceContext& context, const AttachmentFormats& formats);

    void set_colors(const Image& colors) { colors_.set({&colors}); }

    /// Makes its pipeline, if there is none yet.
    void prepare(const DeviceContext& context);
    bool is_prepared() const noexcept { return pipeline_ != VK_NULL_HANDLE; }

    /// Within the scissor.
    void record(Commands commands) const;

private:
    AttachmentFormats formats_;
    SampledImages colors_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

}  // namespace rimline
