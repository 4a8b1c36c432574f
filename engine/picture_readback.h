#pragma once

// The way of a picture back to the host: an image to draw into, a buffer to copy it to, and the bytes.

#include "engine/vulkan/memory.h"
#include "engine/vulkan/picture_target.h"
#include "silhouette/picture.h"

namespace rimline {

/// Of pictures that are drawn for the host.
constexpr VkFormat k_picture_format = VK_FORMAT_R8G8B8A8_UNORM;

/// Throws Error{too_large} naming the limit.
Image make_picture_image(const DeviceContext& context, VkExtent2D size);
/// Such an image to draw into, ready to be copied afterwards.
PictureTarget picture_target(const Image& image) noexcept;

/// Room for a picture of this size, 4 bytes a pixel.
Buffer make_picture_buffer(const DeviceContext& context, VkExtent2D size);
/// Copies an image in TRANSFER_SRC_OPTIMAL to such a buffer; the host reads it when the commands are done.
void record_read_back(VkCommandBuffer commands, VkImage image, VkExtent2D size,
                      const Buffer& pixels);
/// What was copied there, of an image of k_picture_format or of B8G8R8A8_UNORM.
Picture read_picture(const Buffer& pixels, VkExtent2D size, VkFormat format = k_picture_format);

}  // namespace rimline
