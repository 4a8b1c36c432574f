#include "silhouette/mesh/material_inks.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "silhouette/srgb.h"

namespace rimline {

namespace {

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

struct ColorSum {
    glm::dvec3 color{0.0};
    double faces = 0.0;

    void add(const glm::dvec3& other) {
        color += other;
        faces += 1.0;
    }
    glm::vec3 mean() const { return glm::vec3(color / faces); }
};

// Distances are near to how different colors look, as those in sRGB are, at less cost.
glm::vec3 perceived(const glm::vec3& color) { return glm::sqrt(glm::clamp(color, 0.0f, 1.0f)); }

// The number of the box that holds a color, where `steps` of them lie along each axis.
std::uint32_t box_of(const glm::vec3& color, std::uint32_t steps) {
    const glm::vec3 place = perceived(color) * static_cast<float>(steps);
    std::uint32_t box = 0;
    for (int c = 0; c < 3; ++c)
        box = steps * box + std::min(static_cast<std::uint32_t>(place[c]), steps - 1);
    return box;
}

// A color for each box of the finest, or nothing if there are too many.
std::optional<MaterialInks> distinct_inks(const FaceMaterials& materials) {
    MaterialInks inks;
    inks.of_face.assign(materials.of_face.size(), k_no_material_ink);
    std::map<std::uint32_t, std::uint8_t> ink_of_box;
    std::vector<ColorSum> sums;
    for (std::size_t face = 0; face < materials.of_face.size(); ++face) {
        if (materials.of_face[face] == k_no_material) continue;
        const glm::vec3 color = face_color(materials, face);
        const auto [place, is_new] =
            ink_of_box.try_emplace(box_of(color, 256), static_cast<std::uint8_t>(sums.size()));
        if (is_new && sums.size() == k_max_material_inks) return std::nullopt;
        if (is_new) sums.emplace_back();
        inks.of_face[face] = place->second;
        sums[place->second].add(color);
    }
    for (const ColorSum& sum : sums) inks.colors.push_back(sum.mean());
    return inks;
}

struct ColorBox {
    std::size_t number = 0;
    glm::dvec3 place{0.0};  // The mean color, as perceived.
    ColorSum sum;
    std::uint8_t ink = 0;
};

struct BoxGroup {
    std::span<ColorBox> boxes;
    int axis = 0;                       // Along which their faces differ most.
    double mean = 0.0, variance = 0.0;  // Along the axis; the latter is a sum over the faces.

    explicit BoxGroup(std::span<ColorBox> all) : boxes(all) {
        ColorSum places;
        for (const ColorBox& box : boxes) {
            places.color += box.sum.faces * box.place;
            places.faces += box.sum.faces;
        }
        const glm::dvec3 center = places.color / places.faces;
        glm::dvec3 variances(0.0);
        for (const ColorBox& box : boxes)
            variances += box.sum.faces * (box.place - center) * (box.place - center);
        for (int c = 1; c < 3; ++c)
            if (variances[c] > variances[axis]) axis = c;
        mean = center[axis];
        variance = variances[axis];
    }
};

// Gives every box its ink, and returns their number.
std::size_t split_boxes(std::span<ColorBox> boxes) {
    std::vector<BoxGroup> groups{BoxGroup(boxes)};
    while (groups.size() < k_max_material_inks) {
        BoxGroup& widest = *std::ranges::max_element(groups, {}, &BoxGroup::variance);
        const auto middle = std::partition(
            widest.boxes.begin(), widest.boxes.end(),
            [&](const ColorBox& box) { return box.place[widest.axis] < widest.mean; });
        const std::span<ColorBox> below(widest.boxes.begin(), middle),
            above(middle, widest.boxes.end());
        if (below.empty() || above.empty()) break;  // All are one color.
        widest = BoxGroup(below);
        groups.emplace_back(above);
    }
    for (std::size_t ink = 0; ink < groups.size(); ++ink)
        for (ColorBox& box : groups[ink].boxes) box.ink = static_cast<std::uint8_t>(ink);
    return groups.size();
}

MaterialInks joined_inks(const FaceMaterials& materials) {
    constexpr std::uint32_t k_steps = 32;
    std::vector<ColorSum> sums(std::size_t{k_steps} * k_steps * k_steps);
    std::vector<std::uint16_t> box_of_face(materials.of_face.size());
    for (std::size_t face = 0; face < materials.of_face.size(); ++face) {
        if (materials.of_face[face] == k_no_material) continue;
        const glm::vec3 color = face_color(materials, face);
        box_of_face[face] = static_cast<std::uint16_t>(box_of(color, k_steps));
        sums[box_of_face[face]].add(color);
    }
    std::vector<ColorBox> boxes;
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (sums[i].faces > 0.0)
            boxes.push_back({.number = i, .place = perceived(sums[i].mean()), .sum = sums[i]});
    const std::size_t ink_count = split_boxes(boxes);

    MaterialInks inks;
    std::vector<ColorSum> ink_sums(ink_count);
    std::vector<std::uint8_t> ink_of_box(sums.size());
    for (const ColorBox& box : boxes) {
        ink_of_box[box.number] = box.ink;
        ink_sums[box.ink].color += box.sum.color;
        ink_sums[box.ink].faces += box.sum.faces;
    }
    for (const ColorSum& sum : ink_sums) inks.colors.push_back(sum.mean());
    for (std::size_t face = 0; face < materials.of_face.size(); ++face)
        inks.of_face.push_back(materials.of_face[face] == k_no_material
                                   ? k_no_material_ink
                                   : ink_of_box[box_of_face[face]]);
    return inks;
}

}  // namespace

MaterialInks material_inks(const FaceMaterials& materials) {
    if (std::optional<MaterialInks> inks = distinct_inks(materials)) return *std::move(inks);
    return joined_inks(materials);
}

glm::vec3 line_shade(const glm::vec3& surface, bool is_light) {
    if (is_light) return glm::mix(surface, glm::vec3(1.0f), 0.5f);
    // Rec. 709. White becomes sRGB 63 of 255.
    constexpr float k_share = 0.25f, k_max_luminance = 0.05f;
    const float luminance = glm::dot(surface, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    return surface * std::min(k_share, k_max_luminance / std::max(luminance, k_max_luminance));
}

}  // namespace rimline
