#pragma once

// Silhouette and border lines with a width in pixels and round ends, as coverage: red where seen, green
// where hidden. A compositing pass inks them (shaders/composite.frag).

#include "engine/draw_list.h"
#include "engine/pipeline.h"
#include "engine/sampled_images.h"

namespace rimline {

class LinePass {
public:
    /// Draws into one two-channel attachment of `coverage_format`.
    LinePass(const DeviceContext& context, VkFormat coverage_format);

    /// The finished depth of the surfaces, one sample a pixel.
    void set_surface_depth(const Image& depth) { depth_.set({&depth}); }

    /// Inside a rendering scope with the coverage cleared to zero.
    void record(VkCommandBuffer commands, const DrawList& list) const;

private:
    SampledImages depth_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

}  // namespace rimline
