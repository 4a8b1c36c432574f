#pragma once

// Depth and shading. First what shadow leaves of every surface, with depth; then, for each light, what
// it adds where the stencil is zero.

#include "engine/draw_list.h"
#include "engine/pipeline.h"

namespace rimline {

class SurfacePass {
public:
    SurfacePass(const DeviceContext& context, const AttachmentFormats& formats);

    /// Writes color and depth. Inside a rendering scope with cleared attachments.
    void record_unlit(VkCommandBuffer commands, const DrawList& list) const;
    /// Adds light `light` where depth is what record_unlit() left and the stencil is zero.
    void record_lit(VkCommandBuffer commands, const DrawList& list, std::size_t light) const;

private:
    OwnedPipelineLayout layout_;
    OwnedPipeline unlit_;
    OwnedPipeline lit_;
};

}  // namespace rimline
