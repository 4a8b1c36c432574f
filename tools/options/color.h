#pragma once

// Colors as users write them: in hexadecimal digits, or by name.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rimline::tools {

/// sRGB and straight alpha, 8 bits per channel.
struct Color {
    std::uint8_t red, green, blue;
    std::uint8_t alpha = 255;
    bool operator==(const Color&) const = default;
};

/// `#rgb`, `#rrggbb`, the same with alpha as a further digit or two, or a color name of CSS (Color Module Level 4,
/// 148 names), in upper or lower case, or one of ours: paper, sky. Nothing for another text.
std::optional<Color> color_of(std::string_view text);

/// All names, those of CSS first.
std::vector<std::string> color_names();

/// "; did you mean 'NAME'?" for a mistyped name; else empty.
std::string nearest_color(std::string_view text);

}  // namespace rimline::tools
