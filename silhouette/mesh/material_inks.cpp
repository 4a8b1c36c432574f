#include "silhouette/mesh/material_inks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "silhouette/srgb.h"

namespace rimline {

namespace {

using ColorBox = std::array<std::uint32_t, 3>;

std::uint32_t wrapped_pixel(float coordinate, TextureWrap wrap, std::uint32_t size) {
    double share = double{coordinate};
    if (wrap == TextureWrap::mirror) {
        share -= 2.0 * std::floor(0.5 * share);
        if (share > 1.0) share = 2.0 - share;
    } else if (wrap == TextureWrap::repeat) {
        share -= std::floor(share);
    }
    return static_cast<std::uint32_t>(std::clamp(share * size, 0.0, double(size - 1)));
}

glm::vec3 texture_color(const MaterialTexture& texture, const glm::vec2& uv) {
    if (!texture.picture) return glm::vec3(1.0f);
    const Picture& picture = *texture.picture;
    const std::uint32_t x = wrapped_pixel(uv.x, texture.wrap_u, picture.width);
    const std::uint32_t y = wrapped_pixel(uv.y, texture.wrap_v, picture.height);
    const std::uint8_t* pixel =
        picture.rgba.data() + std::size_t{4} * (std::size_t{picture.width} * y + x);
    return linear_from_srgb(glm::vec3(pixel[0], pixel[1], pixel[2]) / 255.0f);
}

// The color in the middle of a face that has a material.
glm::vec3 face_color(const FaceMaterials& materials, std::size_t face) {
    glm::vec3 color = materials.materials[index(materials.of_face[face])].base_color;
    const auto mean = [&](const auto& corners) {
        return (corners[3 * face] + corners[3 * face + 1] + corners[3 * face + 2]) / 3.0f;
    };
    if (!materials.corner_colors.empty()) color *= mean(materials.corner_colors);
    if (const TextureId texture = materials.texture_of(face); texture != k_no_texture)
        color *= texture_color(materials.textures[index(texture)], mean(materials.corner_uvs));
    return color;
}

// The colors of sRGB in boxes with sides of 1 / `steps`.
ColorBox box_of(const glm::vec3& color, std::uint32_t steps) {
    const glm::vec3 srgb = srgb_from_linear(glm::clamp(color, 0.0f, 1.0f));
    ColorBox box{};
    for (int c = 0; c < 3; ++c)
        box[std::size_t(c)] =
            std::min(static_cast<std::uint32_t>(srgb[c] * static_cast<float>(steps)), steps - 1);
    return box;
}

}  // namespace

MaterialInks material_inks(const FaceMaterials& materials) {
    struct Sum {
        glm::dvec3 color{0.0};
        double faces = 0.0;
    };
    std::vector<Sum> sums(materials.materials.size());
    for (std::size_t face = 0; face < materials.of_face.size(); ++face) {
        if (materials.of_face[face] == k_no_material) continue;
        Sum& sum = sums[index(materials.of_face[face])];
        sum.color += glm::dvec3(face_color(materials, face));
        sum.faces += 1.0;
    }
    // Coarser boxes until there are few enough. With one box, all colors are one.
    for (std::uint32_t steps = 256;; steps /= 2) {
        MaterialInks inks;
        std::map<ColorBox, std::uint32_t> boxes;
        std::vector<Sum> box_sums;
        for (const Sum& sum : sums) {
            inks.of_material.push_back(0);
            if (sum.faces == 0.0) continue;
            const ColorBox box = box_of(glm::vec3(sum.color / sum.faces), steps);
            const auto [place, is_new] =
                boxes.try_emplace(box, static_cast<std::uint32_t>(box_sums.size()));
            if (is_new) box_sums.emplace_back();
            inks.of_material.back() = place->second;
            box_sums[place->second].color += sum.color;
            box_sums[place->second].faces += sum.faces;
        }
        if (box_sums.size() > k_max_material_inks) continue;
        for (const Sum& sum : box_sums) inks.colors.emplace_back(sum.color / sum.faces);
        return inks;
    }
}

glm::vec3 line_shade(const glm::vec3& surface, bool is_light) {
    if (is_light) return glm::mix(surface, glm::vec3(1.0f), 0.5f);
    // Rec. 709. White becomes sRGB 63 of 255.
    constexpr float k_share = 0.25f, k_max_luminance = 0.05f;
    const float luminance = glm::dot(surface, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    return surface * std::min(k_share, k_max_luminance / std::max(luminance, k_max_luminance));
}

}  // namespace rimline
