#include "silhouette/picture.h"

#include <png.h>

#include "silhouette/error.h"

namespace rimline {

std::vector<std::byte> encode_png(const Picture& picture) {
    RIMLINE_CHECK(picture.rgba.size() == std::size_t{4} * picture.width * picture.height);
    std::vector<std::uint8_t> rgb;
    rgb.reserve(picture.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
        rgb.insert(rgb.end(), &picture.rgba[i], &picture.rgba[i] + 3);

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = picture.width;
    image.height = picture.height;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr) == 0)
        throw Error(ErrorCode::io, std::string("PNG: ") + image.message);
    bytes.resize(size);
    return bytes;
}

}  // namespace rimline
