#pragma once

// Lines of one color laid over the surfaces, where a scene has lines of several. Coverage is that of one
// color at a time: within a color capsules join without seams (line_pass.h), and between colors the later
// one lies over the earlier, at its own coverage. The last color is left to the composite pass, and a
// scene of one color never comes here.

#include "engine/composite_pass.h"
#include "engine/pipeline.h"
#include "engine/sampled_images.h"

namespace rimline {

class InkPass {
public:
    /// Lays ink over one color attachment of `surface_format`, one sample a pixel.
    InkPass(const DeviceContext& context, VkFormat surface_format);

    void set_lines(const Image& lines) { lines_.set({&lines}); }

    /// Inside a rendering scope with the surfaces as color. The grid lies under the ink; only the first
    /// color may bring one. `scale` x `scale` pixels of the surfaces make one of the picture.
    void record(VkCommandBuffer commands, const CompositeColors& colors, std::uint32_t scale) const;

private:
    SampledImages lines_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

}  // namespace rimline
