#include "silhouette/picture.h"

#include <doctest/doctest.h>
#include <png.h>

namespace rimline {
namespace {

TEST_CASE("a picture survives PNG, but for its alpha") {
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

}  // namespace
}  // namespace rimline
