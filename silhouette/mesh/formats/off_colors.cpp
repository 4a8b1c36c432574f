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
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const double number = scanner.number(tokens[i], what);
        if (!(number >= 0.0 && number <= 255.0))
            scanner.fail(std::string(what) + " has a channel " + excerpt(tokens[i]) +
                         "; channels are integers from 0 to 255, or numbers from 0 to 1");
        numbers[i] = float_of(number);
        if (i < 3 && !parse_integer(tokens[i])) color.kind = OffColor::Kind::real;
    }
    color.numbers = {numbers[0], numbers[1], numbers[2]};
    // Alpha may be an integer where the others are not.
    const std::size_t count = color.kind == OffColor::Kind::integer ? tokens.size() : 3;
    float& largest = largest_[static_cast<std::size_t>(color.kind)];
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, numbers[i]);
    return color;
}

glm::vec3 OffColors::linear(const OffColor& color) const {
    if (color.kind == OffColor::Kind::none) return k_no_color;
    const float scale = color_number_scale(largest_[static_cast<std::size_t>(color.kind)]);
    return linear_from_srgb(clamped_color(scale * color.numbers));
}

}  // namespace rimline
