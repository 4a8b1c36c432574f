#pragma once

// The finished picture: ink over a grid over surfaces, samples averaged in linear light, encoded as the target's
// format wants it (picture_target.h).

#include <glm/vec4.hpp>
#include <map>

#include "engine/picture_target.h"
#include "engine/pipeline.h"
#include "engine/sampled_images.h"

namespace rimline {

/// In linear light.
struct CompositeColors {
    glm::vec4 ink;   ///< Alpha is the strength of hidden lines.
    glm::vec4 grid;  ///< Alpha is the strength of its lines; 0: no grid.
};

class CompositePass {
public:
    explicit CompositePass(const DeviceContext& context);

    /// Makes ready for targets of `format`; has no effect the second time. Throws Error{bad_input} naming
    /// the format where the device cannot draw into it, or where it is none of colors.
    void prepare(const DeviceContext& context, VkFormat format);

    void set_images(const Image& surfaces, const Image& lines) { images_.set({&surfaces, &lines}); }

    /// For targets of a prepared `format`; `scale` x `scale` texels of the images make one pixel.
    void record(VkCommandBuffer commands, VkFormat format, const CompositeColors& colors,
                std::uint32_t scale) const;

private:
    SampledImages images_;
    OwnedPipelineLayout layout_;
    std::map<VkFormat, OwnedPipeline> pipelines_;
};

}  // namespace rimline
