// Surfaces with textures, against the pictures themselves.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>

#include "engine/renderer.h"
#include "engine/stream/mip_levels.h"
#include "engine/view_defaults.h"
#include "silhouette/srgb.h"
#include "tests/engine/support/changed_functions.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_texture_side = 64;  // Of pictures, in pixels.

Picture random_picture(std::uint32_t width, std::uint32_t height, std::uint32_t seed) {
    std::mt19937 random(seed);
    Picture picture{width, height, {}};
    for (std::size_t i = 0; i < std::size_t{4} * width * height; ++i)
        picture.rgba.push_back(i % 4 == 3 ? std::uint8_t{255} : std::uint8_t(random() % 256));
    return picture;
}

Picture one_color(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    return {1, 1, {red, green, blue, 255}};
}

MaterialTexture texture_of(Picture picture) {
    return {.place = "a test", .picture = std::make_shared<const Picture>(std::move(picture))};
}

// A square from -2 to 2 that faces z, with texture coordinates from (0, 0) left above to (range, range).
MeshSource textured_square(float range, MaterialTexture texture) {
    MeshSource source{{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    FaceMaterials& materials = source.materials;
    materials.textures.push_back(std::move(texture));
    materials.materials = {{.texture = TextureId{0}}};
    materials.of_face = {MaterialId{0}, MaterialId{0}};
    for (const auto& triangle : source.triangles)
        for (const std::uint32_t v : triangle)
            materials.corner_uvs.push_back(
                range * glm::vec2(source.positions[v].x + 2.0f, 2.0f - source.positions[v].y) /
                4.0f);
    return source;
}

// Its picture in full light, where the square fills it.
Picture draw(Gpu& gpu, const MeshSource& source, Style style = Style::toon, bool shadows = false,
             std::uint32_t side = k_texture_side) {
    const Model model(source);
    Scene scene{.camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .ortho_height = 4.0},
                .style = style,
                .palette = default_palette(style, style_defaults(style).background),
                .lines = false};
    scene.shadows = shadows;
    scene.lights = {{.vector = {0, 0, 1}, .directional = true}};
    scene.instances.push_back({.octree = &model.octree});
    return Renderer(gpu.context(), {.samples = 1, .scale = 1}).render(scene, side, side);
}

int greatest_difference(const Picture& a, const Picture& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    int greatest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        greatest = std::max(greatest, std::abs(a.rgba[i] - b.rgba[i]));
    return greatest;
}

std::array<int, 3> pixel(const Picture& picture, std::uint32_t x, std::uint32_t y) {
    const std::size_t at = 4 * (std::size_t{picture.width} * y + x);
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
}

bool is_near(const std::array<int, 3>& a, const std::array<int, 3>& b) {
    for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(a[c] - b[c]) > 2) return false;
    return true;
}

PFN_vkCreateSampler create_sampler = nullptr;
int made_samplers = 0;

VKAPI_ATTR VkResult VKAPI_CALL count_sampler(VkDevice device, const VkSamplerCreateInfo* info,
                                             const VkAllocationCallbacks* callbacks,
                                             VkSampler* sampler) {
    ++made_samplers;
    return create_sampler(device, info, callbacks, sampler);
}

TEST_CASE("meshes share the samplers of their textures") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext context = with_functions(gpu->context(), [](DeviceFunctions& vk) {
        create_sampler = vk.CreateSampler;
        vk.CreateSampler = &count_sampler;
    });
    const Model first(textured_square(1.0f, texture_of(one_color(255, 0, 0))));
    const Model second(textured_square(1.0f, texture_of(one_color(0, 255, 0))));
    MaterialTexture clamped = texture_of(one_color(0, 0, 255));
    clamped.wrap_u = TextureWrap::clamp;
    const Model third(textured_square(1.0f, clamped));
    Renderer renderer(context, {.samples = 1, .scale = 1});
    Scene scene{.camera = {.eye = {0, 0, 5}}};
    const auto samplers_with = [&](const Model& model) {
        scene.instances.push_back({.octree = &model.octree});
        made_samplers = 0;
        renderer.render(scene, 16, 16);
        return made_samplers;
    };
    CHECK(samplers_with(first) == 1);
    CHECK(samplers_with(second) == 0);
    CHECK(samplers_with(third) == 1);
}

TEST_CASE("a texture whose pixels fall on those of the picture is the picture") {
    RIMLINE_OPEN_GPU(gpu);
    const Picture picture = random_picture(k_texture_side, k_texture_side, 1);
    const MeshSource square = textured_square(1.0f, texture_of(picture));
    for (const Style style : {Style::toon, Style::ink, Style::hatch})
        for (const bool shadows : {false, true}) {
            CAPTURE(static_cast<int>(style));
            CAPTURE(shadows);
            const Picture drawn = draw(*gpu, square, style, shadows);
            save_picture("texture", drawn, {});
            // Light is summed in half floats, and filters have eight bits between two pixels.
            CHECK(greatest_difference(drawn, picture) <= 3);
        }
    // A base color multiplies it, in linear light.
    MeshSource half = square;
    half.materials.materials[0].base_color = glm::vec3(0.5f);
    const Picture drawn = draw(*gpu, half);
    int wrong = 0;
    for (std::size_t i = 0; i < drawn.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        const float linear = 0.5f * linear_from_srgb(glm::vec3(float(picture.rgba[i]) / 255.0f)).x;
        wrong +=
            std::abs(float(drawn.rgba[i]) - 255.0f * srgb_from_linear(glm::vec3(linear)).x) > 3;
    }
    CHECK(wrong == 0);
}

TEST_CASE("textures repeat, mirror and end as their file says, each way") {
    RIMLINE_OPEN_GPU(gpu);
    const Picture picture = random_picture(k_texture_side / 4, k_texture_side / 4, 2);
    const auto place = [](TextureWrap wrap, std::uint32_t at) {
        const std::uint32_t n = k_texture_side / 4;
        if (wrap == TextureWrap::clamp) return std::min(at, n - 1);
        if (wrap == TextureWrap::mirror && at / n % 2 == 1) return n - 1 - at % n;
        return at % n;
    };
    for (const TextureWrap u : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp})
        for (const TextureWrap v : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
            CAPTURE(static_cast<int>(u));
            CAPTURE(static_cast<int>(v));
            MaterialTexture texture = texture_of(picture);
            texture.wrap_u = u;
            texture.wrap_v = v;
            const Picture drawn = draw(*gpu, textured_square(4.0f, texture));
            int wrong = 0;
            for (std::uint32_t y = 0; y < k_texture_side; ++y)
                for (std::uint32_t x = 0; x < k_texture_side; ++x)
                    wrong += !is_near(pixel(drawn, x, y), pixel(picture, place(u, x), place(v, y)));
            CHECK(wrong == 0);
        }
}

TEST_CASE("a pixelated texture has sharp edges, and another one is interpolated") {
    RIMLINE_OPEN_GPU(gpu);
    const Picture picture{2, 1, {255, 255, 255, 255, 0, 0, 0, 255}};
    for (const bool is_pixelated : {true, false}) {
        MaterialTexture texture = texture_of(picture);
        texture.is_pixelated = is_pixelated;
        texture.wrap_u = TextureWrap::clamp;
        const Picture drawn = draw(*gpu, textured_square(1.0f, texture));
        int between = 0;
        for (std::uint32_t x = 0; x < k_texture_side; ++x) {
            const int value = pixel(drawn, x, 5)[0];
            between += value > 5 && value < 250;
        }
        // Between the centers of both pixels: half of the width.
        CHECK((is_pixelated ? between == 0 : between > 20));
    }
}

TEST_CASE("a texture much finer than the picture has its mean color, in linear light") {
    RIMLINE_OPEN_GPU(gpu);
    Picture checker{256, 256, {}};
    for (std::uint32_t i = 0; i < 256 * 256; ++i) {
        const auto value = static_cast<std::uint8_t>((i + i / 256) % 2 == 0 ? 255 : 0);
        checker.rgba.insert(checker.rgba.end(), {value, value, 0, 255});
    }
    const Picture drawn = draw(*gpu, textured_square(3.0f, texture_of(checker)));
    int wrong = 0;
    for (std::uint32_t y = 0; y < k_texture_side; ++y)
        for (std::uint32_t x = 0; x < k_texture_side; ++x)
            wrong += !is_near(pixel(drawn, x, y), {188, 188, 0});
    CHECK(wrong == 0);
}

TEST_CASE("faces of several textures, of none, and of a missing one share a mesh") {
    RIMLINE_OPEN_GPU(gpu);
    // Columns of one face pair each, in an order that is not that of their textures.
    constexpr std::size_t k_columns = 8;
    MeshSource source;
    FaceMaterials& materials = source.materials;
    materials.textures = {texture_of(one_color(250, 20, 20)),
                          texture_of(one_color(20, 250, 20)),
                          {.place = "missing"}};
    materials.materials = {{.texture = TextureId{0}},
                           {.texture = TextureId{1}},
                           {.base_color = {0, 0, 1}},
                           {.base_color = {0, 1, 1}, .texture = TextureId{2}}};
    for (std::uint32_t i = 0; i < k_columns; ++i) {
        const float x = -2.0f + 0.5f * float(i);
        for (const glm::vec2 corner : {glm::vec2(0, -2), {0.5f, -2}, {0.5f, 2}, {0, 2}})
            source.positions.push_back({x + corner.x, corner.y, 0});
        source.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
        source.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
        const MaterialId material = i % 5 == 4 ? k_no_material : MaterialId{(3 * i) % 4};
        materials.of_face.insert(materials.of_face.end(), 2, material);
        materials.corner_uvs.insert(materials.corner_uvs.end(), 6, glm::vec2(0.5f));
    }
    constexpr std::array<std::array<int, 3>, 4> k_expected{
        {{250, 20, 20}, {20, 250, 20}, {0, 0, 255}, {0, 255, 255}}};
    for (const bool shadows : {false, true}) {
        const Picture drawn = draw(*gpu, source, Style::toon, shadows);
        for (std::uint32_t i = 0; i < k_columns; ++i) {
            CAPTURE(i);
            if (i % 5 == 4) continue;
            CHECK(is_near(pixel(drawn, 4 + 8 * i, 30), k_expected[(3 * i) % 4]));
        }
    }
}

TEST_CASE("a mesh whose textures were not read is drawn in its base colors") {
    RIMLINE_OPEN_GPU(gpu);
    MeshSource source = textured_square(1.0f, {.place = "not read"});
    source.materials.materials[0].base_color = {1, 0, 0};
    CHECK(is_near(pixel(draw(*gpu, source), 20, 20), {255, 0, 0}));
}

TEST_CASE("a picture larger than the device's images is reduced") {
    RIMLINE_OPEN_GPU(gpu);
    const std::uint32_t width = gpu->context().limits.maxImageDimension2D + 2;
    Picture wide{width, 1, {}};
    for (std::uint32_t i = 0; i < width; ++i)
        wide.rgba.insert(wide.rgba.end(),
                         {i < width / 2 ? std::uint8_t{200} : std::uint8_t{20}, 100, 50, 255});
    const Picture drawn = draw(*gpu, textured_square(1.0f, texture_of(wide)));
    CHECK(is_near(pixel(drawn, k_texture_side / 4, 9), {200, 100, 50}));
    CHECK(is_near(pixel(drawn, 3 * k_texture_side / 4, 9), {20, 100, 50}));
}

TEST_CASE("mip levels: each pixel is the mean of what it covers, in linear light") {
    for (const auto [width, height] :
         {std::array{8u, 8u}, std::array{7u, 5u}, std::array{1u, 9u}, std::array{13u, 2u},
          std::array{3u, 3u}, std::array{1u, 1u}}) {
        CAPTURE(width);
        CAPTURE(height);
        const Picture picture = random_picture(width, height, 3);
        const std::vector<Picture> levels = mip_levels(picture, 4096);
        CHECK(levels[0].rgba == picture.rgba);
        CHECK(levels.back().width == 1);
        CHECK(levels.back().height == 1);
        for (std::size_t l = 1; l < levels.size(); ++l) {
            const Picture& large = levels[l - 1];
            const Picture& small = levels[l];
            REQUIRE(small.width == std::max(large.width / 2, 1u));
            REQUIRE(small.height == std::max(large.height / 2, 1u));
            REQUIRE(small.rgba.size() == std::size_t{4} * small.width * small.height);
            int wrong = 0;
            for (std::uint32_t y = 0; y < small.height; ++y)
                for (std::uint32_t x = 0; x < small.width; ++x) {
                    // Points on a grid that is the same for all pixels of both.
                    glm::dvec3 sum(0.0);
                    for (std::uint32_t j = 0; j < large.height; ++j)
                        for (std::uint32_t i = 0; i < large.width; ++i) {
                            const auto at = [](std::uint32_t p, std::uint32_t k, std::uint32_t from,
                                               std::uint32_t to) { return (p * from + k) / to; };
                            const auto color = pixel(large, at(x, i, large.width, small.width),
                                                     at(y, j, large.height, small.height));
                            for (std::size_t c = 0; c < 3; ++c)
                                sum[static_cast<int>(c)] +=
                                    linear_from_srgb(glm::vec3(float(color[c]) / 255.0f)).x;
                        }
                    sum /= double(large.width) * large.height;
                    for (std::size_t c = 0; c < 3; ++c) {
                        const float expected =
                            255.0f * srgb_from_linear(glm::vec3(float(sum[static_cast<int>(c)]))).x;
                        wrong += std::abs(float(pixel(small, x, y)[c]) - expected) > 0.51f;
                    }
                }
            CHECK(wrong == 0);
        }
    }
    CHECK(mip_levels(random_picture(40, 10, 4), 16)[0].width == 10);
}

}  // namespace
}  // namespace rimline
