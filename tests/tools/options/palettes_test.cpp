#include "tools/options/palettes.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <set>
#include <string>

#include "tools/options/picture_scene.h"

namespace rimline::tools {
namespace {

// Relative luminance, and the ratio of two by WCAG 2.
double luminance(const Color& color) {
    return glm::dot(glm::dvec3(linear_from_srgb(color)), glm::dvec3(0.2126, 0.7152, 0.0722));
}
double contrast(const Color& a, const Color& b) {
    const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
    return x > y ? x / y : y / x;
}

TEST_CASE("every style but the mask has palettes with names of their own") {
    std::set<std::pair<Style, std::string>> names;
    for (const NamedPalette& palette : named_palettes()) {
        CAPTURE(palette.name);
        CHECK(names.insert({palette.style, std::string(palette.name)}).second);
        CHECK(palette.name != own_palette(palette.style));
        CHECK(find_palette(palette.style, palette.name) == &palette);
        CHECK(all_palette_names().find(palette.name) != std::string::npos);
    }
    for (const Style style : {Style::ink, Style::toon, Style::blueprint, Style::hatch}) {
        CHECK_FALSE(own_palette(style).empty());
        CHECK(find_palette(style, own_palette(style)) == nullptr);
        CHECK(palette_names(style).find(", ") != std::string::npos);
    }
    CHECK(palette_names(Style::mask).empty());
    CHECK(find_palette(Style::toon, "riso") == nullptr);
}

TEST_CASE("lines stand out from the paper and from surfaces, and shadow is darker than light") {
    for (const NamedPalette& palette : named_palettes()) {
        CAPTURE(palette.name);
        const Color surface = palette.surface.value_or(palette.background);
        CHECK(contrast(palette.lines, palette.background) > 5.0);
        // Toon has light lines around its night, which need not stand out within it.
        CHECK(contrast(palette.lines, surface) > (palette.style == Style::toon ? 2.3 : 5.0));
        CHECK(luminance(palette.shaded) < luminance(surface));
        if (palette.style == Style::toon) CHECK(contrast(surface, palette.background) > 1.4);
    }
}

TEST_CASE("a palette's shaded color is that of its surfaces in shadow") {
    for (const NamedPalette& named : named_palettes()) {
        CAPTURE(named.name);
        const glm::vec3 paper = linear_from_srgb(named.background);
        const Palette palette = engine_palette(named, paper);
        const glm::vec3 surface = linear_from_srgb(named.surface.value_or(named.background));
        CHECK(glm::distance(surface * palette.shade, linear_from_srgb(named.shaded)) < 1e-5f);
        CHECK(palette.background == paper);
        CHECK((palette.grid_strength > 0.0f) == (named.style == Style::blueprint));
    }
}

}  // namespace
}  // namespace rimline::tools
