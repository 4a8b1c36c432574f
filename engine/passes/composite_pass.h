#pragma once

// The finished picture: ink over surfaces, as much as their alpha says that lines cover
// (line_pass.h), samples averaged in linear light, encoded as the target's format wants it
// (picture_target.h).

#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>

#include "engine/vulkan/picture_target.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/sampled_images.h"

namespace rimline {

/// What a pipeline is made for: everything else may change from frame to frame.
struct CompositeKind {
    VkFormat format;      ///< Of the target.
    std::uint32_t scale;  ///< `scale` x `scale` texels of the surfaces make one pixel.
    auto operator<=>(const CompositeKind&) const = default;
};

/// What the composite writes where surfaces are linear `background` and no line is, as a value to clear a
/// target of `format` to. Nothing where another rounding would give another value, and for other formats than
/// 8 bits of plain sRGB.
std::optional<VkClearColorValue> composite_of(const glm::vec3& background, VkFormat format);

class CompositePass {
public:
    explicit CompositePass(const DeviceContext& context);

    /// Makes ready for `kind`; has no effect the second time. Throws Error{bad_input} naming the format where
    /// the device cannot draw into it, or where it is none of colors.
    void prepare(const DeviceContext& context, const CompositeKind& kind);

    void set_surfaces(const Image& surfaces) { surfaces_.set({&surfaces}); }

    /// Into a target of a prepared kind; linear `ink`.
    void record(VkCommandBuffer commands, const CompositeKind& kind, const glm::vec3& ink) const;

private:
    SampledImages surfaces_;
    OwnedPipelineLayout layout_;
    std::map<CompositeKind, OwnedPipeline> pipelines_;
};

}  // namespace rimline
