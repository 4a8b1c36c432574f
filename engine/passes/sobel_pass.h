#pragma once

// Outlines as steps of depth and of normals between pixels, by the Sobel operator: depth as Saito and Takahashi
// (Comprehensible Rendering of 3-D Shapes, 1990), normals as Decaudin (Cartoon-Looking Rendering of 3D-Scenes,
// 1996). It finds creases, borders and self-intersections with silhouettes, and cannot tell them apart. It misses
// silhouettes before a surface that is near and turned alike. A comparator (Outline).

#include "engine/passes/draw_list.h"
#include "engine/renderer_options.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/sampled_images.h"

namespace rimline {

class SobelPass {
public:
    /// Draws into the alpha of one color attachment of `surface_format`, one sample a pixel.
    SobelPass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
              VkFormat surface_format);

    /// The finished image of shape_pass.h.
    void set_shapes(const Image& shapes) { shapes_.set({&shapes}); }

    /// Draws all outlines, as wide as the nearest even number of pixels of the pass to `width_px`, at least 2: a
    /// step is seen from both sides. Inside a rendering scope, in which only `drawn` has shapes.
    void record(Commands commands, const DrawList& list, const Outline& outline, float width_px,
                const VkRect2D& drawn) const;

private:
    SampledImages shapes_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

}  // namespace rimline
