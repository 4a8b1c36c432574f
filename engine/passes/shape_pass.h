#pragma once

// What each pixel shows, as normals and depth: the G-buffer of Saito and Takahashi (Comprehensible Rendering of 3-D
// Shapes, 1990), for sobel_pass.h. Programs that shade from such images have them anyway; here it is one more draw
// of all surfaces. One sample a pixel, in its middle, whatever the samples of the surfaces.

#include "engine/passes/draw_list.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

class ShapePass {
public:
    ShapePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
              const AttachmentFormats& formats);

    /// Writes shapes and depth. Inside a rendering scope with cleared attachments.
    void record(Commands commands, const DrawList& list) const;

private:
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

}  // namespace rimline
