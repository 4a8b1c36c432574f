#pragma once

// Depth and shading. First what shadow leaves of every surface, with depth; then, for each light, what
// it adds where the stencil is zero. Or both at once, where one light casts no shadows.
//
// Each style has pipelines of its own. With one for all, which asks for the style in the fragment stage,
// lavapipe computed the strokes of hatch for every pixel, and threw them away: two thirds of a frame.

#include <map>

#include "engine/frame/draw_list.h"
#include "engine/scene.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

class SurfacePass {
public:
    SurfacePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                const AttachmentFormats& formats);

    /// Makes ready for lists of `style`, before they are recorded; has no effect the second time.
    void prepare(const DeviceContext& context, Style style);

    /// Writes color and depth. Inside a rendering scope with cleared attachments.
    void record_unlit(VkCommandBuffer commands, const DrawList& list) const;
    /// The same as record_unlit() and record_lit() of the only light, where the stencil is all zero.
    void record_shadowless(VkCommandBuffer commands, const DrawList& list) const;
    /// Adds light `light` where depth is what record_unlit() left and the stencil is zero.
    void record_lit(VkCommandBuffer commands, const DrawList& list, std::size_t light) const;

private:
    // Of one style, by whether an instance fades.
    struct Pipelines {
        OwnedPipeline unlit[2], lit[2], shadowless[2];
        OwnedPipeline unlit_by_vertices[2];  // Null where a style's shade has strokes.
    };

    void record(VkCommandBuffer commands, const DrawList& list, const OwnedPipeline (&pipelines)[2],
                std::size_t light) const;

    AttachmentFormats formats_;
    OwnedPipelineLayout layout_;
    std::map<std::uint32_t, Pipelines> pipelines_;
};

}  // namespace rimline
