#pragma once

// The image that a frame is drawn into: a caller's, a swapchain's, or the renderer's for a picture that is
// read back.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>

namespace rimline {

/// How a format's values are stored.
enum class PictureEncoding {
    srgb,  ///< Plain integers of 5 to 16 bits: the composite writes sRGB.
    linear,  ///< Floats, or an sRGB format, which the device encodes: the composite writes linear light.
    impossible,  ///< Unnormalized integers, depth, compressed formats, and all others.
};
PictureEncoding encoding_of(VkFormat format) noexcept;

/// The aspects of a depth format; 0 for a format that has no depth.
VkImageAspectFlags depth_aspects(VkFormat format) noexcept;

/// What a frame does to its target.
enum class PictureUse {
    whole,  ///< Writes every pixel, with alpha 1: the scene on its background.
    /// Writes every pixel, with premultiplied alpha: 1 where surfaces and lines are, 0 where nothing is. A
    /// shadow on what others have drawn is black, with the part of the light that it takes as alpha. There is no
    /// background, and no grid.
    layer,
    /// The same with straight alpha: color is not multiplied by it. Where alpha is 0, color is black. For files.
    straight,
    /// Blends that layer over the target's content: color + (1 - alpha) * content, and alpha likewise. Formats
    /// that encode light themselves, and floats, blend linear light. Others blend their encoded values.
    over,
};

/// The depth of what another renderer has drawn already. It hides surfaces and lines that lie behind it, and
/// receives shadows. Its samples are those of the frame: with it, the scale is 1, and RendererOptions::samples
/// must be its number of samples. Depths are those of Camera::projection or, without one, of make_projection(),
/// without any change by the viewport. Depth at the far plane means that nothing was drawn.
struct BackdropDepth {
    VkImage image = VK_NULL_HANDLE;  ///< With VK_IMAGE_USAGE_SAMPLED_BIT.
    VkImageView view =
        VK_NULL_HANDLE;  ///< 2D, of the depth aspect alone. Pixels are those of the target.
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t samples = 1;
    std::uint32_t layer = 0;
    /// Stages of yours that wrote it and that the frame must wait for, besides attachments and copies. The frame reads
    /// it in fragment shaders: order your next write after these (VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT) by a
    /// barrier of yours. The frame has none for it.
    VkPipelineStageFlags2 earlier_stages = VK_PIPELINE_STAGE_2_NONE;
    /// While the frame reads it; the frame neither writes it nor moves it to another layout.
    VkImageLayout layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
};

/// Whether a frame that the GPU has begun goes on. The passes after `value`, of 32 bits, has become 0 draw nothing, or
/// their later draws; a device may also go on as if it were not 0. The target's content is then undefined, and its
/// layouts are those of every frame; silhouettes are complete. Write the value from the host at any time, to memory
/// that is coherent. Without DeviceFeatures::conditional_rendering prepare() throws Error{bad_input}.
struct FrameCondition {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< With VK_BUFFER_USAGE_CONDITIONAL_RENDERING_BIT_EXT.
    VkDeviceSize offset = 0;           ///< Of the value; a multiple of 4.
};

/// One layer of a 2D color image with one sample a pixel and VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT.
struct PictureTarget {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;      ///< Of mip level 0 and `layer`.
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< The view's.
    VkExtent2D extent{};                    ///< Of the frame.
    VkOffset2D corner{};  ///< Of the frame in the image. Nothing outside of the frame changes.
    std::uint32_t layer = 0;
    /// The layouts before and after the commands. UNDEFINED is valid at first if the image has no content to
    /// keep.
    VkImageLayout initial_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout final_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    /// Stages of yours, before the frame and after it, that it is ordered with besides those that the two
    /// layouts allow (layout_uses.h). Examples: a write by a compute shader that your own barrier did not order
    /// before, and reads in ray tracing stages. VK_IMAGE_LAYOUT_GENERAL allows every stage.
    VkPipelineStageFlags2 earlier_stages = VK_PIPELINE_STAGE_2_NONE;
    VkPipelineStageFlags2 later_stages = VK_PIPELINE_STAGE_2_NONE;
    PictureUse use = PictureUse::whole;
    std::optional<BackdropDepth> backdrop;
    std::optional<FrameCondition> condition;  ///< Nothing: the whole frame is drawn.
};

}  // namespace rimline
