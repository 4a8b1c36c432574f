#include "silhouette/picture.h"

#include <doctest/doctest.h>
#include <png.h>

#include <array>
#include <stop_token>
#include <string>

#include "silhouette/error.h"

namespace rimline {
namespace {

// Some pixels, all different.
Picture make_picture(std::uint32_t width, std::uint32_t height) {
    Picture picture{width, height, {}};
    for (std::uint32_t i = 0; i < 4 * width * height; ++i)
        picture.rgba.push_back(i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(i * 37));
    return picture;
}

// The message, or "" where the bytes are a picture. Any other exception escapes.
std::string refusal(std::span<const std::byte> bytes) {
    try {
        static_cast<void>(decode_png(bytes));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return "";
}

std::vector<std::byte> written(png_image& image, const void* pixels) {
    std::vector<std::byte> bytes(PNG_IMAGE_PNG_SIZE_MAX(image));
    png_alloc_size_t size = bytes.size();
    REQUIRE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr) != 0);
    bytes.resize(size);
    return bytes;
}

TEST_CASE("a picture without alpha survives PNG, but for its alpha") {
    Picture picture{3, 2, {}};
    for (std::uint8_t i = 0; i < 24; ++i)
        picture.rgba.push_back(i % 4 == 3 ? std::uint8_t{255} : std::uint8_t(i * 10));
    const std::vector<std::byte> bytes = encode_png(picture);

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) != 0);
    CHECK(image.width == 3);
    CHECK(image.height == 2);
    CHECK(image.format == PNG_FORMAT_RGB);
    image.format = PNG_FORMAT_RGBA;
    std::vector<std::uint8_t> read(24);
    REQUIRE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr) != 0);
    CHECK(read == picture.rgba);
}

TEST_CASE("a picture with alpha survives PNG") {
    Picture picture = make_picture(9, 7);
    picture.has_alpha = true;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = std::uint8_t(i * 5);
    const Picture read = decode_png(encode_png(picture));
    CHECK(read.has_alpha);
    CHECK(read.rgba == picture.rgba);
    picture.has_alpha = false;
    CHECK_FALSE(decode_png(encode_png(picture)).has_alpha);
}

TEST_CASE("decode_png reads what encode_png writes") {
    for (const auto [width, height] : {std::array{1u, 1u}, std::array{3u, 2u}, std::array{200u, 1u},
                                       std::array{1u, 200u}, std::array{64u, 64u}}) {
        Picture picture = make_picture(width, height);
        std::vector<std::byte> bytes = encode_png(picture);
        const Picture read = decode_png(bytes);
        CHECK(read.width == width);
        CHECK(read.height == height);
        CHECK(read.rgba == picture.rgba);
        bytes.push_back(std::byte{7});  // Ignored.
        CHECK(decode_png(bytes).rgba == picture.rgba);
        // Alpha is not written.
        for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 17;
        CHECK(encode_png(picture) == encode_png(read));
    }
}

TEST_CASE("a stop ends encode_png between two rows") {
    std::stop_source stop;
    double last = 0.0;
    const LongCall call{stop.get_token(), [&](double done) {
                            last = done;
                            if (done >= 0.5) stop.request_stop();
                        }};
    CHECK_THROWS_AS(encode_png(make_picture(4, 100), call), Error);
    CHECK(last == 0.5);
}

TEST_CASE("decode_png reads alpha and gray and 16 bits") {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 2;
    image.height = 1;
    image.format = PNG_FORMAT_RGBA;
    const std::vector<std::uint8_t> rgba{10, 20, 30, 40, 250, 240, 230, 0};
    CHECK(decode_png(written(image, rgba.data())).rgba == rgba);
    image.format = PNG_FORMAT_GRAY;
    const std::vector<std::uint8_t> gray{0, 200};
    CHECK(decode_png(written(image, gray.data())).rgba ==
          std::vector<std::uint8_t>{0, 0, 0, 255, 200, 200, 200, 255});
    image.format = PNG_FORMAT_LINEAR_Y;
    const std::vector<std::uint16_t> linear{0, 65535};
    CHECK(decode_png(written(image, linear.data())).rgba ==
          std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255, 255, 255});
}

TEST_CASE("decode_png refuses a PNG that is cut off anywhere") {
    const std::vector<std::byte> bytes = encode_png(make_picture(9, 7));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        CAPTURE(size);
        // A copy, so that a sanitizer sees what is read behind its end.
        const std::vector<std::byte> cut(bytes.begin(),
                                         bytes.begin() + static_cast<std::ptrdiff_t>(size));
        CHECK(refusal(cut) == (size == 0 ? "PNG: not a PNG file" : "PNG: truncated"));
    }
}

TEST_CASE("decode_png refuses a PNG with a damaged byte or reads a picture of the same size") {
    const Picture picture = make_picture(9, 7);
    const std::vector<std::byte> bytes = encode_png(picture);
    std::size_t refused = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        for (const std::byte bit : {std::byte{1}, std::byte{0x80}}) {
            CAPTURE(i);
            std::vector<std::byte> damaged = bytes;
            damaged[i] ^= bit;
            if (!refusal(damaged).empty()) {
                ++refused;
                continue;
            }
            const Picture read = decode_png(damaged);
            CHECK(read.width == picture.width);
            CHECK(read.height == picture.height);
            CHECK(read.rgba.size() == picture.rgba.size());
        }
    CHECK(refused > bytes.size());
}

TEST_CASE("decode_png refuses other bytes than PNG and pictures with too many pixels") {
    CHECK(refusal({}) == "PNG: not a PNG file");
    const std::vector<std::byte> zeros(100);
    CHECK(refusal(zeros) == "PNG: not a PNG file");
    // The width and height of a small picture, which libpng alone would make memory for.
    std::vector<std::byte> bytes = encode_png(make_picture(2, 2));
    const auto set_size = [&](std::uint32_t width, std::uint32_t height) {
        for (std::size_t i = 0; i < 4; ++i) {
            bytes[16 + i] = static_cast<std::byte>(width >> (24 - 8 * i));
            bytes[20 + i] = static_cast<std::byte>(height >> (24 - 8 * i));
        }
        // IHDR's checksum, of its type and data.
        std::uint32_t crc = 0xffffffffu;
        for (std::size_t i = 12; i < 29; ++i) {
            crc ^= std::to_integer<std::uint32_t>(bytes[i]);
            for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1u ? 0xedb88320u : 0u);
        }
        for (std::size_t i = 0; i < 4; ++i)
            bytes[29 + i] = static_cast<std::byte>(~crc >> (24 - 8 * i));
    };
    set_size(2, 2);
    CHECK(refusal(bytes).empty());
    set_size(1u << 15, 1u << 14);
    CHECK(refusal(bytes) == "PNG: more than 2^28 pixels");
    set_size(0x7fffffffu, 0x7fffffffu);
    CHECK(refusal(bytes).starts_with("PNG: "));
    set_size(0, 2);
    CHECK(refusal(bytes).starts_with("PNG: "));
    set_size(2, 40);  // More than the file has.
    CHECK(refusal(bytes).starts_with("PNG: "));
}

}  // namespace
}  // namespace rimline
