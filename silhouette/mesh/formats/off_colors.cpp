#include "silhouette/mesh/formats/off_colors.h"

#include <algorithm>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/float_of.h"
#include "silhouette/srgb.h"

namespace rimline {

OffColor OffColors::read(const TextScanner& scanner, std::span<const std::string_view> tokens,
                         const char* what) {
    RIMLINE_CHECK(tokens.size() == 3 || tokens.size() == 4);
    OffColor color{.kind = OffColor::Kind::integer};
    std::array<float, 4> numbers{};
    std::string_view wrong;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const double number = scanner.number(tokens[i], what);
        const bool is_channel = number >= 0.0 && number <= 255.0;
        if (!is_channel && i < 3) wrong = tokens[i];
        numbers[i] = is_channel ? float_of(number) : 0.0f;
        if (i < 3 && !parse_integer(tokens[i])) color.kind = OffColor::Kind::real;
    }
    if (!wrong.empty()) {
        warn(scanner, std::string(what) + " has a channel " + excerpt(wrong) +
                          ", which is not from 0 to 255; such a color is not used");
        return {};
    }
    color.numbers = {numbers[0], numbers[1], numbers[2]};
    // Alpha may be an integer where the others are not.
    const std::size_t count = color.kind == OffColor::Kind::integer ? tokens.size() : 3;
    float& largest = largest_[static_cast<std::size_t>(color.kind)];
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, numbers[i]);
    return color;
}

void OffColors::warn(const TextScanner& scanner, const std::string& what) {
    if (warning_.empty())
        warning_ = std::string(scanner.name()) + ":" + std::to_string(scanner.line()) + ": " + what;
}

glm::vec3 OffColors::linear(const OffColor& color) const {
    if (color.kind == OffColor::Kind::none) return k_no_color;
    const float scale = color_number_scale(largest_[static_cast<std::size_t>(color.kind)]);
    return linear_from_srgb(clamped_color(scale * color.numbers));
}

}  // namespace rimline
