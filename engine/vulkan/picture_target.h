#pragma once

// The image that a frame is drawn into: a caller's own, a swapchain's, or the renderer's for a picture
// that goes back to the host.

#include <vulkan/vulkan.h>

#include <cstdint>

namespace rimline {

/// How a format's values are stored.
enum class PictureEncoding {
    srgb,  ///< Plain 8 to 16 bits: the composite writes sRGB.
    linear,  ///< Floats, or an sRGB format, which encodes by itself: the composite writes linear light.
    impossible,  ///< Integers, depth, compressed, or not a color at all.
};
PictureEncoding encoding_of(VkFormat format) noexcept;

/// One layer of a 2D color image of one sample, with VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT. Every pixel
/// is overwritten, alpha with 1.
struct PictureTarget {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;      ///< Of mip level 0 and `layer`.
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< The view's.
    VkExtent2D extent{};
    std::uint32_t layer = 0;
    /// What the image is in when the commands begin, and left in; UNDEFINED fits any beginning.
    VkImageLayout initial_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout final_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
};

}  // namespace rimline
