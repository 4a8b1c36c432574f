#pragma once

// The finished picture: ink over a grid over surfaces, samples averaged in linear light, encoded as the target's
// format wants it (picture_target.h).

#include <compare>
#include <cstdint>
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

/// What a pipeline is made for: everything else may change from frame to frame.
struct CompositeKind {
    VkFormat format;      ///< Of the target.
    std::uint32_t scale;  ///< `scale` x `scale` texels of the images make one pixel.
    bool has_grid;        ///< Else CompositeColors::grid counts for nothing.
    auto operator<=>(const CompositeKind&) const = default;
};

class CompositePass {
public:
    explicit CompositePass(const DeviceContext& context);

    /// Makes ready for `kind`; has no effect the second time. Throws Error{bad_input} naming the format where
    /// the device cannot draw into it, or where it is none of colors.
    void prepare(const DeviceContext& context, const CompositeKind& kind);

    void set_images(const Image& surfaces, const Image& lines) { images_.set({&surfaces, &lines}); }

    /// Into a target of a prepared kind.
    void record(VkCommandBuffer commands, const CompositeKind& kind,
                const CompositeColors& colors) const;

private:
    SampledImages images_;
    OwnedPipelineLayout layout_;
    std::map<CompositeKind, OwnedPipeline> pipelines_;
};

}  // namespace rimline
