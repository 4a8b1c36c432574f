#include "tools/options/palettes.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "tools/options/offered_values.h"
#include "tools/options/picture_scene.h"
#include "tools/options/style_names.h"

namespace rimline::tools {

namespace {

constexpr Color rgb(std::uint32_t value) {
    return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8),
            static_cast<std::uint8_t>(value)};
}

constexpr std::nullopt_t k_as_background = std::nullopt;

// Background, surfaces, lines, surfaces in shadow, grid.
constexpr std::array<NamedPalette, 17> k_palettes{{
    {Style::ink, "sepia", rgb(0xf4e8d2), k_as_background, rgb(0x3a2415), rgb(0xc9a77c)},
    {Style::ink, "indigo", rgb(0xf3f4fa), k_as_background, rgb(0x1c2260), rgb(0xa3add9)},
    {Style::ink, "riso", rgb(0xf8f1e2), k_as_background, rgb(0x21378c), rgb(0xf89c88)},
    {Style::ink, "chalk", rgb(0x2e3d38), k_as_background, rgb(0xf2efe4), rgb(0x1f2b27)},
    {Style::ink, "night", rgb(0x171a24), rgb(0x2b3145), rgb(0xe9e4d4), rgb(0x12141c)},
    {Style::toon, "sea", rgb(0xeef4f1), rgb(0x48b3a6), rgb(0x0b2630), rgb(0x22697a)},
    {Style::toon, "moss", rgb(0xf4f1e3), rgb(0x9cb560), rgb(0x1d2a17), rgb(0x557046)},
    {Style::toon, "plum", rgb(0xf7eff2), rgb(0xc77aa3), rgb(0x241028), rgb(0x6e4080)},
    {Style::toon, "gold", rgb(0xfbf4e2), rgb(0xecb944), rgb(0x33190a), rgb(0xb46f2c)},
    {Style::toon, "midnight", rgb(0x1b2036), rgb(0x7d97e6), rgb(0xf2efe6), rgb(0x36428c)},
    {Style::blueprint, "diazo", rgb(0xf2efe6), rgb(0xe9e7e2), rgb(0x2d4687), rgb(0xd3d3da),
     rgb(0x7b95cf), 0.30f},
    {Style::blueprint, "sepia", rgb(0x4c2d1c), rgb(0x633d2a), rgb(0xf7e8d2), rgb(0x543324),
     rgb(0xc79c70), 0.12f},
    {Style::blueprint, "graphite", rgb(0x2b2e34), rgb(0x3f444d), rgb(0xe9edf3), rgb(0x353941),
     rgb(0x8e98a6), 0.10f},
    {Style::blueprint, "phosphor", rgb(0x07150d), rgb(0x10301f), rgb(0x86ffb0), rgb(0x0d2618),
     rgb(0x35a463), 0.14f},
    {Style::hatch, "sanguine", rgb(0xf5e8d5), k_as_background, rgb(0x8e3220), rgb(0xb0a798)},
    {Style::hatch, "blue", rgb(0xf0f3f8), k_as_background, rgb(0x1b3a7d), rgb(0xacafb3)},
    {Style::hatch, "kraft", rgb(0xcdb08a), k_as_background, rgb(0x2b1a10), rgb(0x937d61)},
}};

}  // namespace

std::span<const NamedPalette> named_palettes() { return k_palettes; }

std::string_view own_palette(Style style) {
    switch (style) {
        case Style::ink: return "paper";
        case Style::toon: return "clay";
        case Style::blueprint: return "cyanotype";
        case Style::hatch: return "pen";
        case Style::mask: break;
    }
    return {};
}

const NamedPalette* find_palette(Style style, std::string_view name) {
    const auto* found = std::ranges::find_if(k_palettes, [&](const NamedPalette& palette) {
        return palette.style == style && palette.name == name;
    });
    return found == k_palettes.end() ? nullptr : found;
}

Palette engine_palette(const NamedPalette& named, const glm::vec3& background) {
    const glm::vec3 surface = linear_from_srgb(named.surface.value_or(named.background));
    // The engine takes shadow as a factor, so that surfaces in other colors have one too.
    const glm::vec3 shade = glm::min(
        linear_from_srgb(named.shaded) / glm::max(surface, glm::vec3(1e-4f)), glm::vec3(1.0f));
    return {background, linear_from_srgb(named.lines), shade,
            linear_from_srgb(named.grid.value_or(named.lines)), named.grid_strength};
}

std::string palette_names(Style style) {
    std::string names(own_palette(style));
    for (const NamedPalette& palette : k_palettes)
        if (palette.style == style) names.append(", ").append(palette.name);
    return names;
}

std::vector<std::string> offered_palettes() {
    std::vector<std::string> names;
    const auto add = [&](std::string_view name) {
        if (!name.empty() && std::ranges::find(names, name) == names.end())
            names.emplace_back(name);
    };
    for (const Style style : k_styles) {
        add(own_palette(style));
        for (const NamedPalette& palette : k_palettes)
            if (palette.style == style) add(palette.name);
    }
    return names;
}

std::string all_palette_names() {
    std::string all;
    for (const Style style : k_styles)
        if (!own_palette(style).empty())
            all.append(all.empty() ? "" : "; ")
                .append(style_name(style))
                .append(": ")
                .append(palette_names(style));
    return all;
}

}  // namespace rimline::tools
