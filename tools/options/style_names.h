#pragma once

// The styles by their names in options, scene files and the window.

#include <array>
#include <cstddef>
#include <string_view>

#include "engine/scene.h"

namespace rimline::tools {

/// As users are shown them.
inline constexpr std::array k_styles{Style::ink, Style::toon, Style::blueprint, Style::hatch,
                                     Style::mask};
/// By place in k_styles.
inline constexpr std::array<const char*, k_styles.size()> k_style_names{"ink", "toon", "blueprint",
                                                                        "hatch", "mask"};

/// The place in both.
constexpr std::size_t place_of(Style style) {
    std::size_t place = 0;
    while (k_styles[place] != style) ++place;
    return place;
}
constexpr const char* style_name(Style style) { return k_style_names[place_of(style)]; }
/// `name` must be one of k_style_names.
constexpr Style style_named(std::string_view name) {
    std::size_t place = 0;
    while (k_style_names[place] != name) ++place;
    return k_styles[place];
}

}  // namespace rimline::tools
