#pragma once

// Draws over the finished surfaces, in their image: the paper's grid, under all lines, and, where a scene has
// lines of several colors, the ink of each color but the last. Coverage is of one color at a time: within a
// color, capsules join without seams (line_pass.h); between colors, the later one is blended over the
// earlier ones by its own coverage. The composite pass draws the last color.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

class InkPass {
public:
    /// Draws into one color attachment of `surface_format`, one sample a pixel.
    InkPass(const DeviceContext& context, VkFormat surface_format);

    /// The paper's grid in linear `color`, whose alpha is the opacity of its lines. `size` is in pixels of
    /// the picture; each has `scale` x `scale` pixels of the surfaces.
    void record_grid(Commands commands, const glm::vec4& color, VkExtent2D size,
                     std::uint32_t scale) const;

    /// Blends linear `ink` by the coverage, and resets the coverage to zero for the next color.
    void record_ink(Commands commands, const glm::vec3& ink) const;

private:
    OwnedPipelineLayout layout_;
    OwnedPipeline grid_, ink_;
};

}  // namespace rimline
