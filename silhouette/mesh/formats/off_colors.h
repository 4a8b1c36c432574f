#pragma once

// The colors of one list of an OFF file: of its vertices, or of its faces.
//
// Geomview writes a color as three or four integers in [0, 255] or as three or four numbers with a decimal point in
// [0, 1]. Other programs write 1.0 as "1" or 255 as "255.0". Therefore the colors with a point or an exponent and those
// without are two kinds, and each kind of a list is in [0, 255] if one of its numbers is 2 or more, otherwise in
// [0, 1]. An alpha is not used; that of an integer color counts for the range. Colors are sRGB.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/formats/text_scanner.h"

namespace rimline {

/// A color as the file has it.
struct OffColor {
    enum class Kind : std::uint8_t { none, integer, real };
    glm::vec3 numbers{0.0f};
    Kind kind = Kind::none;
};

class OffColors {
public:
    /// The color that three or four tokens spell, or none, with a warning, for a channel outside of [0, 255]. `what`
    /// names it in messages. Throws Error{bad_input} with the line for a word that is no number.
    OffColor read(const TextScanner& scanner, std::span<const std::string_view> tokens,
                  const char* what);

    /// The color in linear light, after all were read. k_no_color for none.
    glm::vec3 linear(const OffColor& color) const;

    /// Keeps the first warning, with the line.
    void warn(const TextScanner& scanner, const std::string& what);
    /// Why colors are not used, or empty.
    const std::string& warning() const noexcept { return warning_; }

private:
    std::string warning_;
    std::array<float, 3> largest_{};  // The greatest number of each kind.
};

}  // namespace rimline
