#pragma once

// The finished picture: ink over surfaces, samples averaged in linear light, sRGB.

#include <glm/vec4.hpp>

#include "engine/pipeline.h"
#include "engine/sampled_images.h"

namespace rimline {

class CompositePass {
public:
    CompositePass(const DeviceContext& context, VkFormat picture_format);

    void set_images(const Image& surfaces, const Image& lines) { images_.set({&surfaces, &lines}); }

    /// `ink` is linear, its alpha the strength of hidden lines; `scale` x `scale` texels of the images
    /// make one pixel.
    void record(VkCommandBuffer commands, const glm::vec4& ink, std::uint32_t scale) const;

private:
    SampledImages images_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

}  // namespace rimline
