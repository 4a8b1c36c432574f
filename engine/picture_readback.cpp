#include "engine/picture_readback.h"

#include <utility>

#include "engine/vulkan/barrier.h"

namespace rimline {

namespace {

constexpr const char* k_name = "the picture";

}  // namespace

Image make_picture_image(const DeviceContext& context, VkExtent2D size) {
    return {context,
            {.format = k_picture_format,
             .extent = size,
             .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
            k_name};
}

PictureTarget picture_target(const Image& image) noexcept {
    return {.image = image.handle(),
            .view = image.attachment_view(),
            .format = image.description().format,
            .extent = image.description().extent,
            .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
}

Buffer make_picture_buffer(const DeviceContext& context, VkExtent2D size) {
    return {context, VkDeviceSize{4} * size.width * size.height, BufferPlace::readback, k_name};
}

void record_read_back(Commands commands, VkImage image, VkExtent2D size, const Buffer& pixels) {
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {size.width, size.height, 1}};
    commands->CmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                   pixels.handle(), 1, &region);
    record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

Picture read_picture(const Buffer& pixels, VkExtent2D size, VkFormat format) {
    Picture picture{size.width, size.height, {}};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(pixels.mapped());
    picture.rgba.assign(bytes, bytes + std::size_t{4} * size.width * size.height);
    if (format == VK_FORMAT_B8G8R8A8_UNORM)
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
            std::swap(picture.rgba[i], picture.rgba[i + 2]);
    return picture;
}

}  // namespace rimline
