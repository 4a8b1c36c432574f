#pragma once

// Named sets of colors for the styles. The first one of a style is its own colors (engine/view_defaults.h).

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/scene.h"
#include "tools/options/color.h"

namespace rimline::tools {

struct NamedPalette {
    Style style;
    std::string_view name;
    Color background;
    std::optional<Color> surface;  ///< Not set: as the background.
    Color lines;
    Color
        shaded;  ///< What a surface becomes in shadow. In Style::hatch its mean light is left as paper.
    std::optional<Color> grid{};
    float grid_strength = 0.0f;
};

/// All but the first ones of the styles, which need no colors.
std::span<const NamedPalette> named_palettes();
/// The name of the first palette of a style; empty for Style::mask, which has none.
std::string_view own_palette(Style style);

/// Null if the style has no such palette, and for its first one.
const NamedPalette* find_palette(Style style, std::string_view name);
/// The palette in linear light. `background` is that of the picture.
Palette engine_palette(const NamedPalette& named, const glm::vec3& background);

/// "paper, sepia, ..."; empty for Style::mask.
std::string palette_names(Style style);
/// For help: "ink: paper, ...; toon: ...".
std::string all_palette_names();

}  // namespace rimline::tools
