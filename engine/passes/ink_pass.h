#pragma once

// Draws over the finished surfaces, in their image: the paper's grid, under all lines, and, where a scene has
// lines of several colors, the ink of each color but the last. Coverage is of one color at a time: within a
// color, capsules join without seams (line_pass.h); between colors, the later one is blended over the
// earlier ones by its own coverage. The composite pass draws the last color. Where the surfaces' alpha is
// opacity, coverage has an image of its own, and every color is drawn here.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/sampled_images.h"

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

    /// For record_fold(): makes its pipeline, if there is none yet; and sets its coverage.
    void prepare_fold(const DeviceContext& context);
    void set_coverage(const Image& coverage) { coverage_.set({&coverage}); }
    bool is_fold_prepared() const noexcept { return fold_ != VK_NULL_HANDLE; }

    /// Blends linear `ink` by the coverage, over premultiplied surfaces.
    void record_fold(Commands commands, const glm::vec3& ink) const;

private:
    VkFormat surface_format_;
    OwnedPipelineLayout layout_;
    OwnedPipeline grid_, ink_;
    SampledImages coverage_;
    OwnedPipelineLayout fold_layout_;
    OwnedPipeline fold_;
};

}  // namespace rimline
