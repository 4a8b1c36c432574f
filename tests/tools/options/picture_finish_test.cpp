#include "tools/options/picture_finish.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/vec3.hpp>

#include "silhouette/srgb.h"

namespace rimline::tools {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

Pixel finished(const PictureFinish& finish, const Pixel& pixel) {
    Picture picture{1, 1, {pixel.begin(), pixel.end()}};
    finish.apply(picture);
    CHECK(picture.has_alpha == finish.has_alpha);
    return {picture.rgba[0], picture.rgba[1], picture.rgba[2], picture.rgba[3]};
}

// What a viewer shows of a gray pixel on a gray background: it blends encoded values.
double viewed(const Pixel& pixel, double under) {
    const double alpha = pixel[3] / 255.0;
    return alpha * pixel[0] + (1.0 - alpha) * under;
}

// What the renderer shows: it blends linear light.
double rendered(const Pixel& pixel, double under) {
    const float alpha = float(pixel[3]) / 255.0f;
    const float over = linear_from_srgb(glm::vec3(float(pixel[0]) / 255.0f)).x;
    const float below = linear_from_srgb(glm::vec3(float(under) / 255.0f)).x;
    return 255.0 * srgb_from_linear(glm::vec3(alpha * over + (1.0f - alpha) * below)).x;
}

TEST_CASE("a picture without alpha is left as it is") {
    CHECK(finished({}, {10, 20, 30, 255}) == Pixel{10, 20, 30, 255});
}

TEST_CASE("viewers show black on every color, and white on black, as the renderer does") {
    const PictureFinish finish{.has_alpha = true};
    for (int alpha = 0; alpha <= 255; ++alpha) {
        CAPTURE(alpha);
        const Pixel black{0, 0, 0, std::uint8_t(alpha)}, white{255, 255, 255, std::uint8_t(alpha)};
        const Pixel shown = finished(finish, black);
        CHECK(shown[0] == 0);
        CHECK(std::abs(viewed(shown, 255) - rendered(black, 255)) < 0.6);
        // e is not exactly a power.
        for (double under : {60.0, 128.0, 200.0})
            CHECK(std::abs(viewed(shown, under) - rendered(black, under)) < 11.0);
        CHECK(std::abs(viewed(finished(finish, white), 0) - rendered(white, 0)) < 0.6);
    }
}

TEST_CASE("alpha stays 0 where nothing is and 1 where a surface is, and grows in between") {
    const PictureFinish finish{.has_alpha = true};
    for (int value = 0; value <= 255; value += 5) {
        CAPTURE(value);
        const std::uint8_t gray = std::uint8_t(value);
        CHECK(finished(finish, {gray, gray, gray, 0})[3] == 0);
        int before = 0;
        for (int alpha = 1; alpha <= 255; ++alpha) {
            const Pixel pixel = finished(finish, {gray, gray, gray, std::uint8_t(alpha)});
            CHECK(pixel[3] >= before);
            CHECK(pixel[0] == gray);
            before = pixel[3];
        }
        CHECK(before == 255);
    }
}

TEST_CASE("a translucent background lies under the picture") {
    const PictureFinish finish{.has_alpha = true, .under = Color{200, 100, 50, 128}};
    CHECK(finished(finish, {0, 0, 0, 0}) == Pixel{200, 100, 50, 128});
    CHECK(finished(finish, {9, 8, 7, 255}) == Pixel{9, 8, 7, 255});
    const Pixel between = finished(finish, {0, 0, 0, 128});
    CHECK(between[3] > 128);
    CHECK(between[0] > 0);
    CHECK(between[0] < 200);
    // Nothing under nothing.
    CHECK(finished({.has_alpha = true, .under = Color{200, 100, 50, 0}}, {0, 0, 0, 0})[3] == 0);
}

TEST_CASE("a mask has only black and white, and transparent black") {
    const PictureFinish opaque{.is_mask = true}, transparent{.has_alpha = true, .is_mask = true};
    for (int value = 0; value <= 255; ++value)
        for (int alpha = 0; alpha <= 255; alpha += 3) {
            const std::uint8_t gray = std::uint8_t(value);
            const Pixel flat = finished(opaque, {gray, gray, gray, 255});
            CHECK(flat == (value >= 188 ? Pixel{255, 255, 255, 255} : Pixel{0, 0, 0, 255}));
            const Pixel cut = finished(transparent, {gray, gray, gray, std::uint8_t(alpha)});
            CHECK(cut == (alpha < 128 ? Pixel{0, 0, 0, 0} : flat));
        }
}

}  // namespace
}  // namespace rimline::tools
