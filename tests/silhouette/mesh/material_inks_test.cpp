#include "silhouette/mesh/material_inks.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <set>

#include "silhouette/srgb.h"

namespace rimline {
namespace {

FaceMaterials one_face_each(const std::vector<glm::vec3>& colors) {
    FaceMaterials materials;
    for (const glm::vec3& color : colors) {
        materials.of_face.push_back(
            MaterialId{static_cast<std::uint32_t>(materials.of_face.size())});
        materials.materials.push_back({.base_color = color});
    }
    return materials;
}

bool is_close(const glm::vec3& a, const glm::vec3& b) { return glm::distance(a, b) < 1e-5f; }

// Four pixels: red and green above blue and white.
MaterialTexture four_pixels() {
    return {.place = "a test",
            .picture = std::make_shared<const Picture>(Picture{
                2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}})};
}

TEST_CASE("the ink of a face is the color of its material times the mean of its corners' colors") {
    FaceMaterials materials = one_face_each({{1.0f, 0.5f, 0.25f}, {0.2f, 0.2f, 0.2f}});
    materials.of_face = {MaterialId{0}, k_no_material, MaterialId{0}, MaterialId{1}};
    CHECK(is_close(material_inks(materials).colors[0], {1.0f, 0.5f, 0.25f}));
    materials.corner_colors.assign(12, glm::vec3(1.0f));
    for (std::size_t corner = 0; corner < 2; ++corner)
        materials.corner_colors[corner] = {0.0f, 1.0f, 0.0f};
    const MaterialInks inks = material_inks(materials);
    CHECK(inks.of_face == std::vector<std::uint8_t>{0, k_no_material_ink, 1, 2});
    REQUIRE(inks.colors.size() == 3);
    // Two of three corners are green.
    CHECK(is_close(inks.colors[0], {1.0f / 3.0f, 0.5f, 0.25f / 3.0f}));
    CHECK(is_close(inks.colors[1], {1.0f, 0.5f, 0.25f}));
    CHECK(is_close(inks.colors[2], glm::vec3(0.2f)));
    CHECK(material_inks({}).colors.empty());
}

TEST_CASE("textures count in the middle of a face, wherever their coordinates lie") {
    FaceMaterials materials = one_face_each({glm::vec3(0.5f)});
    materials.textures = {four_pixels()};
    materials.materials[0].texture = TextureId{0};
    const auto ink_at = [&](glm::vec2 middle, TextureWrap wrap) {
        materials.textures[0].wrap_u = materials.textures[0].wrap_v = wrap;
        materials.corner_uvs = {middle + glm::vec2(0.1f, 0.0f), middle - glm::vec2(0.1f, 0.1f),
                                middle + glm::vec2(0.0f, 0.1f)};
        return 2.0f * material_inks(materials).colors[0];
    };
    constexpr glm::vec3 k_red(1, 0, 0), k_green(0, 1, 0), k_blue(0, 0, 1), k_white(1.0f);
    for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
        CHECK(is_close(ink_at({0.25f, 0.25f}, wrap), k_red));
        CHECK(is_close(ink_at({0.75f, 0.25f}, wrap), k_green));
        CHECK(is_close(ink_at({0.25f, 0.75f}, wrap), k_blue));
        CHECK(is_close(ink_at({0.75f, 0.75f}, wrap), k_white));
    }
    CHECK(is_close(ink_at({1.25f, -1.75f}, TextureWrap::repeat), k_red));
    CHECK(is_close(ink_at({1.25f, -1.75f}, TextureWrap::mirror), k_green));
    CHECK(is_close(ink_at({1.25f, -1.75f}, TextureWrap::clamp), k_green));
    CHECK(is_close(ink_at({-1e30f, 1e30f}, TextureWrap::clamp), k_blue));
    // Any of its pixels, but one of them.
    for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror}) {
        const glm::vec3 far = ink_at({1e30f, -1e30f}, wrap);
        const std::vector<glm::vec3> pixels{k_red, k_green, k_blue, k_white};
        CHECK(std::ranges::any_of(pixels, [&](const glm::vec3& p) { return is_close(far, p); }));
    }
    materials.textures[0].picture = nullptr;
    CHECK(is_close(ink_at({0.25f, 0.25f}, TextureWrap::repeat), k_white));
}

TEST_CASE("many colors share few inks, each near to its own color") {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> channel(0.0f, 1.0f);
    std::vector<glm::vec3> colors;
    for (int i = 0; i < 300; ++i)
        colors.push_back(linear_from_srgb({channel(random), channel(random), channel(random)}));
    const MaterialInks many = material_inks(one_face_each(colors));
    CHECK(many.colors.size() == k_max_material_inks);
    float greatest = 0.0f;
    for (std::size_t i = 0; i < colors.size(); ++i)
        greatest =
            std::max(greatest, glm::distance(srgb_from_linear(colors[i]),
                                             srgb_from_linear(many.colors[many.of_face[i]])));
    CHECK(greatest < 0.6f);  // Of 1.7, the diagonal of all colors.

    colors.resize(k_max_material_inks);
    const MaterialInks few = material_inks(one_face_each(colors));
    for (std::size_t i = 0; i < colors.size(); ++i)
        CHECK(is_close(few.colors[few.of_face[i]], colors[i]));
    colors.insert(colors.end(), colors.begin(), colors.end());
    CHECK(material_inks(one_face_each(colors)).colors.size() == k_max_material_inks);
}

TEST_CASE("a rainbow has its inks spread over it, however many faces one color has") {
    constexpr std::size_t k_count = 3000;
    std::vector<glm::vec3> colors;
    for (std::size_t i = 0; i < k_count; ++i) {
        const float turn = 3.0f * static_cast<float>(i) / k_count;
        glm::vec3 color(0.0f);
        color[int(turn)] = int(turn) + 1.0f - turn;
        color[(int(turn) + 1) % 3] = turn - int(turn);
        colors.push_back(color);
    }
    colors.insert(colors.end(), k_count, glm::vec3(0.5f));
    const MaterialInks inks = material_inks(one_face_each(colors));
    CHECK(inks.colors.size() == k_max_material_inks);
    for (std::size_t i = 0; i < colors.size(); ++i)
        CHECK(glm::distance(srgb_from_linear(colors[i]),
                            srgb_from_linear(inks.colors[inks.of_face[i]])) < 0.3f);
    CHECK(is_close(inks.colors[inks.of_face.back()], glm::vec3(0.5f)));
}

TEST_CASE("lines are dark shades of the surface's hue, and pale ones on dark paper") {
    CHECK(line_shade(glm::vec3(1.0f), false).x == doctest::Approx(0.05f));
    CHECK(line_shade(glm::vec3(0.0f), false) == glm::vec3(0.0f));
    CHECK(line_shade({0.0f, 0.0f, 1.0f}, false) == glm::vec3(0.0f, 0.0f, 0.25f));
    std::mt19937 random(2);
    std::uniform_real_distribution<float> channel(0.0f, 1.0f);
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 surface{channel(random), channel(random), channel(random)};
        const glm::vec3 dark = line_shade(surface, false);
        const glm::vec3 pale = line_shade(surface, true);
        CHECK(glm::length(glm::cross(dark, surface)) < 1e-6f);
        for (int c = 0; c < 3; ++c) {
            CHECK(dark[c] <= 0.25f * surface[c]);
            CHECK(pale[c] >= 0.5f);
            CHECK(pale[c] <= 1.0f);
        }
    }
}

}  // namespace
}  // namespace rimline
