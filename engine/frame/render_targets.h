#pragma once

// The images that the passes of one picture size draw into, up to the picture itself.
//
//     surfaces (color, depth + stencil; several samples) --resolved--> surfaces, depth (one sample)
//     lines are drawn against depth into the surfaces' alpha, as coverage; composite averages scale x
//     scale texels to a pixel of the target.
//
// For a layer (PictureUse) the surfaces' alpha is opacity, and coverage has an image of its own. Where the only light
// is drawn with the surfaces (SurfaceLights::beside_shadow), the colors of shadows have an image of their own, and
// surfaces two scopes: of both images with depth, and of shadows over them.

#include <vulkan/vulkan.h>

#include <glm/vec3.hpp>

#include "engine/frame/clear_area.h"
#include "engine/sampling.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/picture_target.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

constexpr VkFormat k_surface_format = VK_FORMAT_R16G16B16A16_SFLOAT;
/// Depth needs all bits of a float.
constexpr VkFormat k_shape_format = VK_FORMAT_R32G32B32A32_SFLOAT;

/// The greatest scale from 1 to `wanted` whose images are within the device's limits and take at most half
/// of its memory; 1 if none is.
std::uint32_t fitting_scale(const DeviceContext& context, VkExtent2D size, std::uint32_t wanted,
                            std::uint32_t samples, bool has_shadow_colors = false);

/// The part of a picture that a frame draws, in pixels of the picture.
struct DrawnArea {
    VkRect2D rect;
    VkClearColorValue around{};  ///< The picture's value outside of `rect`.

    static DrawnArea whole(VkExtent2D size) { return {{{0, 0}, size}}; }
};

class RenderTargets {
public:
    /// What not every frame needs.
    struct Parts {
        bool keeps_stencil = false;  ///< As in RendererOptions.
        bool coverage = false;       ///< For a layer.
        bool shapes = false;
        bool shadow_colors =
            false;  ///< For SurfaceLights::beside_shadow; only with one sample (RIMLINE_CHECK).
    };

    /// Throws Error{too_large} naming the limit.
    RenderTargets(const DeviceContext& context, VkExtent2D size, const Sampling& sampling,
                  const Parts& parts);

    VkExtent2D size() const noexcept { return size_; }
    /// The size of the images that the surface and line passes draw into.
    VkExtent2D pass_extent() const noexcept {
        return {size_.width * scale_, size_.height * scale_};
    }
    /// A rectangle of the picture in pixels of the surface and line passes.
    VkRect2D in_pass(const VkRect2D& rect) const noexcept;
    std::uint32_t scale() const noexcept { return scale_; }
    std::uint32_t samples() const noexcept { return samples_; }
    /// How many times wider and higher than the picture the viewport of the surface and line passes is. The
    /// picture is at its center. A power of two.
    float guard() const noexcept { return guard_; }
    /// Whether a layer can be drawn.
    bool has_coverage() const noexcept { return coverage_.handle() != VK_NULL_HANDLE; }
    bool has_shadow_colors() const noexcept { return shadow_colors_.handle() != VK_NULL_HANDLE; }

    const Image& surfaces() const noexcept { return surfaces_; }
    const Image& depth() const noexcept { return depth_; }
    const Image& coverage() const noexcept { return coverage_; }
    const Image& shadow_colors() const noexcept { return shadow_colors_; }
    /// Normals and depth of what each pixel of the passes shows, one sample each (engine/passes/shape_pass.h). Only
    /// with Parts::shapes.
    const Image& shapes() const noexcept { return shapes_; }

    /// These begin scopes of dynamic rendering. Surfaces and their depth are defined only within the area, to which a
    /// scissor limits all draws; the render area may be larger where something is cleared (clear_area.h). The
    /// area is cleared to linear `background` and alpha 0: no line covers it.
    void begin_surfaces(Commands commands, const glm::vec3& background,
                        const DrawnArea& area) const;
    /// Likewise with the colors of shadows, cleared to the same, as the second attachment.
    void begin_surfaces_beside_shadow(Commands commands, const glm::vec3& background,
                                      const DrawnArea& area) const;
    /// For drawing over these surfaces, with their depth and stencil.
    void begin_shadows(Commands commands, const DrawnArea& area) const;
    /// For drawing over the finished surfaces and into their alpha.
    void begin_lines(Commands commands, const DrawnArea& area) const;
    /// For drawing coverage of lines into its own image, which is cleared.
    void begin_coverage(Commands commands, const DrawnArea& area) const;
    /// For drawing shapes, which are cleared to zero: nothing.
    void begin_shapes(Commands commands, const DrawnArea& area) const;
    /// Clears the target around the area, but for PictureUse::over; the caller must draw every pixel of the
    /// area.
    static void begin_picture(Commands commands, const PictureTarget& target,
                              const DrawnArea& area);

    /// Layout changes between the scopes, for all images at once; the last one includes the target.
    void record_before_surfaces(Commands commands) const;
    void record_before_shadows(Commands commands) const;
    static void record_before_backdrop(Commands commands, const BackdropDepth& backdrop);
    void record_before_lines(Commands commands) const;
    /// Before and after coverage is drawn, to be read by the next scope of lines.
    void record_before_coverage(Commands commands) const;
    void record_after_coverage(Commands commands) const;
    /// Before and after shapes are drawn, to be read by a later scope.
    void record_before_shapes(Commands commands) const;
    void record_after_shapes(Commands commands) const;
    void record_before_picture(Commands commands, const PictureTarget& target) const;
    /// Moves the target to its final layout. Later uses in that layout wait for it (layout_uses.h).
    static void record_after_picture(Commands commands, const PictureTarget& target);

private:
    bool is_multisampled() const noexcept { return samples_ > 1; }
    VkRect2D render_area(const VkRect2D& drawn) const noexcept {
        return clear_area_ == ClearArea::whole ? VkRect2D{{0, 0}, pass_extent()} : drawn;
    }

    VkExtent2D size_;
    std::uint32_t scale_;
    std::uint32_t samples_;
    ClearArea clear_area_;
    bool keeps_stencil_;
    bool must_resolve_stencil_;  // Because depth is.
    float guard_;
    Image surfaces_, depth_;                            // One sample.
    Image coverage_;                                    // Likewise, and only for a layer.
    Image shadow_colors_;                               // Likewise, and only with shadow colors.
    Image shapes_, shapes_depth_;                       // Likewise, and only with shapes.
    Image multisampled_surfaces_, multisampled_depth_;  // Only with several.
};

}  // namespace rimline
