#pragma once

// The finished picture: ink over surfaces, blended by the coverage of lines in the surfaces' alpha
// (line_pass.h), or a layer of premultiplied color; averaged over texels in linear light, and encoded for the
// target's format (picture_target.h).

#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/picture_target.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/sampled_images.h"

namespace rimline {

/// The properties that need a pipeline of their own. Everything else may change between frames.
struct CompositeKind {
    VkFormat format;      ///< Of the target.
    std::uint32_t scale;  ///< `scale` x `scale` texels of the surfaces make one pixel.
    PictureUse use = PictureUse::whole;
    bool is_layer =
        false;  ///< Of the surfaces: alpha is opacity. Always, if the use is not `whole`.
    auto operator<=>(const CompositeKind&) const = default;
};

/// The clear value of a target of `format` that equals what the composite writes where surfaces have the
/// color `background` (linear) and no line is drawn. std::nullopt where another rounding could give another
/// value, and for formats other than plain 8-bit sRGB.
std::optional<VkClearColorValue> composite_of(const glm::vec3& background, VkFormat format);

class CompositePass {
public:
    explicit CompositePass(const DeviceContext& context);

    /// Makes the pipeline for `kind`, if there is none yet. Throws Error{bad_input} naming the format if the
    /// device cannot draw into it, or cannot blend in it for PictureUse::over, or if it is not a color format.
    void prepare(const DeviceContext& context, const CompositeKind& kind);

    bool is_prepared(const CompositeKind& kind) const { return pipelines_.contains(kind); }

    void set_surfaces(const Image& surfaces) { surfaces_.set({&surfaces}); }

    /// Inside a rendering scope of a target of a prepared kind, where the picture begins at `corner`. `color` is
    /// linear: the ink over the surfaces or, for a layer, the background under it.
    void record(Commands commands, const CompositeKind& kind, const glm::vec3& color,
                VkOffset2D corner) const;

private:
    SampledImages surfaces_;
    OwnedPipelineLayout layout_;
    std::map<CompositeKind, OwnedPipeline> pipelines_;
};

}  // namespace rimline
