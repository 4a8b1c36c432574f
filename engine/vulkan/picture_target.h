#pragma once

// The image that a frame is drawn into: a caller's, a swapchain's, or the renderer's for a picture that is
// read back.

#include <vulkan/vulkan.h>

#include <cstdint>

namespace rimline {

/// How a format's values are stored.
enum class PictureEncoding {
    srgb,  ///< Plain integers of 5 to 16 bits: the composite writes sRGB.
    linear,  ///< Floats, or an sRGB format, which the device encodes: the composite writes linear light.
    impossible,  ///< Unnormalized integers, depth, compressed formats, and all others.
};
PictureEncoding encoding_of(VkFormat format) noexcept;

/// One layer of a 2D color image with one sample a pixel and VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT. A frame
/// writes every pixel, with alpha 1.
struct PictureTarget {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;      ///< Of mip level 0 and `layer`.
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< The view's.
    VkExtent2D extent{};
    std::uint32_t layer = 0;
    /// The layouts before and after the commands. UNDEFINED is a valid initial layout for every image.
    VkImageLayout initial_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout final_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
};

}  // namespace rimline
