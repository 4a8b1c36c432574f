#pragma once

// Reading a picture back to the host: an image to draw into, a buffer to copy it to, and the pixels.

#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/picture_target.h"
#include "silhouette/picture.h"

namespace rimline {

/// The format of pictures that are read back.
constexpr VkFormat k_picture_format = VK_FORMAT_R8G8B8A8_UNORM;

/// Throws Error{too_large} naming the limit.
Image make_picture_image(const DeviceContext& context, VkExtent2D size);
/// A target for such an image. Its final layout is TRANSFER_SRC_OPTIMAL.
PictureTarget picture_target(const Image& image) noexcept;

/// A buffer for a picture of this size, 4 bytes a pixel.
Buffer make_picture_buffer(const DeviceContext& context, VkExtent2D size);
/// Copies an image in TRANSFER_SRC_OPTIMAL to such a buffer. The host may read it when the commands are done.
void record_read_back(Commands commands, VkImage image, VkExtent2D size, const Buffer& pixels);
/// The picture copied there. `format` is that of the image: k_picture_format or B8G8R8A8_UNORM.
Picture read_picture(const Buffer& pixels, VkExtent2D size, VkFormat format = k_picture_format);

}  // namespace rimline
