#include "silhouette/mesh/formats/stl_colors.h"

#include <algorithm>
#include <optional>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/srgb.h"

namespace rimline {

namespace {

constexpr unsigned k_bit_15 = 0x8000;

// Five bits of an attribute.
float channel(unsigned attribute, unsigned first_bit) noexcept {
    return static_cast<float>(attribute >> first_bit & 31u) / 31.0f;
}

std::optional<glm::vec3> color_of_header(std::string_view header) {
    constexpr std::string_view k_word = "COLOR=";
    const std::size_t at = header.find(k_word);
    if (at == std::string_view::npos || at + k_word.size() + 4 > header.size()) return std::nullopt;
    glm::vec3 color;
    for (int c = 0; c < 3; ++c)
        color[c] = static_cast<float>(static_cast<unsigned char>(
                       header[at + k_word.size() + static_cast<std::size_t>(c)])) /
                   255.0f;
    return linear_from_srgb(color);
}

std::string shown(std::size_t facet, unsigned attribute) {
    return "facet " + std::to_string(facet) + " has " + std::to_string(attribute);
}

}  // namespace

StlColors stl_colors(std::string_view header, const std::vector<std::uint16_t>& attributes,
                     const std::stop_token& stop) {
    const auto is_zero = [](unsigned attribute) { return attribute == 0; };
    const auto has_bit_15 = [](unsigned attribute) { return (attribute & k_bit_15) != 0; };
    StlColors found;
    const auto add_all = [&](auto&& color_of) {
        found.colors.reserve(attributes.size());
        for (std::size_t i = 0; i < attributes.size(); ++i) {
            if (i % k_checkpoint_interval == 0) LongCall{stop, {}}.checkpoint(0.0);
            found.colors.push_back(color_of(attributes[i]));
        }
    };
    if (const std::optional<glm::vec3> common = color_of_header(header)) {
        const bool have_bit_15 = std::ranges::all_of(attributes, has_bit_15);
        const bool are_one = std::ranges::all_of(
            attributes, [&](unsigned attribute) { return attribute == attributes.front(); });
        const bool is_common =
            are_one && !attributes.empty() &&
            (is_zero(attributes[0]) || attributes[0] == k_bit_15 || attributes[0] == 0xffff);
        add_all([&](unsigned a) {
            return is_common || (has_bit_15(a) && !have_bit_15)
                       ? *common
                       : linear_from_srgb({channel(a, 0), channel(a, 5), channel(a, 10)});
        });
        return found;
    }
    const auto colored = std::ranges::find_if(attributes, has_bit_15);
    if (colored == attributes.end()) return found;
    const auto other =
        std::ranges::find_if(attributes, [&](unsigned a) { return !is_zero(a) && !has_bit_15(a); });
    if (other != attributes.end()) {
        const auto number = [&](auto at) {
            return static_cast<std::size_t>(at - attributes.begin());
        };
        found.warning = "the attributes of its facets are not read as colors: " +
                        shown(number(colored), *colored) + ", which would be one, but " +
                        shown(number(other), *other) +
                        ", and the header has no COLOR=, with which both would be";
        return found;
    }
    add_all([&](unsigned a) {
        return has_bit_15(a) ? linear_from_srgb({channel(a, 10), channel(a, 5), channel(a, 0)})
                             : k_no_color;
    });
    return found;
}

}  // namespace rimline
