#pragma once

// What is laid over the finished surfaces, all in their image: the paper's grid, under all lines,
// and lines of one color where a scene has lines of several. Coverage is that of one color at a
// time: within a color capsules join without seams (line_pass.h), and between colors the later one
// lies over the earlier, at its own coverage. The last color is left to the composite pass.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/vulkan/pipeline.h"

namespace rimline {

class InkPass {
public:
    /// Draws into one color attachment of `surface_format`, one sample a pixel.
    InkPass(const DeviceContext& context, VkFormat surface_format);

    /// The paper's grid in linear `color`, whose alpha is the strength of its lines. `size`, in pixels of the
    /// picture, of which `scale` x `scale` of the surfaces make one.
    void record_grid(VkCommandBuffer commands, const glm::vec4& color, VkExtent2D size,
                     std::uint32_t scale) const;

    /// Linear `ink` where lines are, which are gone then: there is room for those of the next color.
    void record_ink(VkCommandBuffer commands, const glm::vec3& ink) const;

private:
    OwnedPipelineLayout layout_;
    OwnedPipeline grid_, ink_;
};

}  // namespace rimline
