#include "silhouette/picture.h"

#include <png.h>

#include <array>
#include <string>

#include "silhouette/error.h"

namespace rimline {

namespace {

[[noreturn]] void refuse_png(const std::string& why) {
    throw Error(ErrorCode::bad_input, "PNG: " + why);
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (const std::byte byte : bytes.first(4))
        value = value << 8 | std::to_integer<std::uint32_t>(byte);
    return value;
}

// Checks that all chunks are there, to the last: libpng does not read on to it. Of each chunk:
//
//     [ size of data, 4 bytes | type, 4 | data | checksum, 4 ]
void check_png_is_whole(std::span<const std::byte> bytes) {
    constexpr std::array<std::uint8_t, 8> k_signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::uint32_t k_end_type = 0x49454e44;  // IEND
    for (std::size_t i = 0; i < k_signature.size(); ++i) {
        if (i == bytes.size() && i > 0) refuse_png("truncated");
        if (i == bytes.size() || std::to_integer<std::uint8_t>(bytes[i]) != k_signature[i])
            refuse_png("not a PNG file");
    }
    std::span<const std::byte> rest = bytes.subspan(k_signature.size());
    for (bool is_end = false; !is_end;) {
        if (rest.size() < 12) refuse_png("truncated");
        const std::size_t chunk_size = std::size_t{12} + big_endian(rest);
        if (rest.size() < chunk_size) refuse_png("truncated");
        is_end = big_endian(rest.subspan(4)) == k_end_type;
        rest = rest.subspan(chunk_size);
    }
}

}  // namespace

std::vector<std::byte> encode_png(const Picture& picture) {
    RIMLINE_CHECK(picture.rgba.size() == std::size_t{4} * picture.width * picture.height);
    std::vector<std::uint8_t> rgb;
    if (!picture.has_alpha) {
        rgb.reserve(picture.rgba.size() / 4 * 3);
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
            rgb.insert(rgb.end(), &picture.rgba[i], &picture.rgba[i] + 3);
    }
    const std::vector<std::uint8_t>& pixels = picture.has_alpha ? picture.rgba : rgb;

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = picture.width;
    image.height = picture.height;
    image.format = picture.has_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
        throw Error(ErrorCode::io, std::string("PNG: ") + image.message);
    bytes.resize(size);
    return bytes;
}

Picture decode_png(std::span<const std::byte> bytes) {
    check_png_is_whole(bytes);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
        refuse_png(image.message);
    Picture picture{image.width, image.height, {}};
    picture.has_alpha = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    if (std::uint64_t{image.width} * image.height > k_max_decoded_pixels) {
        png_image_free(&image);
        refuse_png("more than 2^28 pixels");
    }
    image.format = PNG_FORMAT_RGBA;
    try {
        picture.rgba.resize(PNG_IMAGE_SIZE(image));
    } catch (...) {
        png_image_free(&image);
        throw;
    }
    // Frees what it holds, also where it fails.
    if (png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr) == 0)
        refuse_png(image.message);
    return picture;
}

}  // namespace rimline
