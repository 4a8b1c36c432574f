#pragma once

// The types of option values, and their strict parsers. A text that is not exactly such a value is a usage
// error; the message names the option, the expected form and the text.
//
// The add_ functions are like those of CLI11: the option writes into `value`, which must outlive parsing.
// They return the option, so that the caller can set its group.

#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/cli_classes.h"
#include "tools/options/color.h"

namespace rimline::tools {

/// Limits of --ortho, in the model's units.
constexpr double k_min_ortho_height = 1e-12, k_max_ortho_height = 1e18;

/// Three finite numbers `x,y,z`, each at most k_max_coordinate in magnitude. Blanks around them are ignored.
/// Throws CLI::ValidationError.
glm::vec3 parse_point(const std::string& option, std::string_view text);
/// The same in double precision, for clouds far from the origin.
glm::dvec3 parse_exact_point(const std::string& option, std::string_view text);
/// As parse_point(), but not zero. Components below k_min_point_component count as zero.
glm::vec3 parse_direction(const std::string& option, std::string_view text);
/// A point of an option that may be left out.
std::optional<glm::dvec3> in_double(const std::optional<glm::vec3>& point);

CLI::Option* add_point(CLI::App& app, const std::string& name, std::optional<glm::vec3>& value,
                       const std::string& description);
CLI::Option* add_exact_point(CLI::App& app, const std::string& name,
                             std::optional<glm::dvec3>& value, const std::string& description);
CLI::Option* add_direction(CLI::App& app, const std::string& name, std::optional<glm::vec3>& value,
                           const std::string& description);
/// Options that may be repeated. Each occurrence appends one value.
CLI::Option* add_points(CLI::App& app, const std::string& name, std::vector<glm::vec3>& values,
                        const std::string& description);
CLI::Option* add_directions(CLI::App& app, const std::string& name, std::vector<glm::vec3>& values,
                            const std::string& description);

/// The same, but the word `auto` sets `is_auto` and appends nothing.
CLI::Option* add_directions_or_auto(CLI::App& app, const std::string& name,
                                    std::vector<glm::vec3>& values, bool& is_auto,
                                    const std::string& description);

/// A finite number in [low, high]. `value` holds the default, which the help shows.
CLI::Option* add_number(CLI::App& app, const std::string& name, double& value, double low,
                        double high, const std::string& description);
/// The same without a default.
CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& value,
                        double low, double high, const std::string& description);
/// A whole number in [low, high]. `value` holds the default, which the help shows.
CLI::Option* add_count(CLI::App& app, const std::string& name, std::uint32_t& value,
                       std::uint32_t low, std::uint32_t high, const std::string& description);

/// A number within bounds, or `word`, which sets `is_word`.
CLI::Option* add_number_or(CLI::App& app, const std::string& name, std::optional<double>& value,
                           double low, double high, const std::string& word, bool& is_word,
                           const std::string& description);

/// The name of an output file. It must end in `ending`, for example ".png", in upper or lower case. Devices,
/// pipes and links in /dev (/dev/stdout) may have any name, and - is standard output. `value` holds the
/// default; empty: no default.
CLI::Option* add_output(CLI::App& app, const std::string& name, std::string& value,
                        const std::string& ending, const std::string& description);

/// color_of() without alpha: everything but the background of a picture is opaque.
CLI::Option* add_color(CLI::App& app, const std::string& name, std::optional<Color>& value,
                       const std::string& description);
/// color_of() with alpha. `none` and CSS's `transparent` set `is_none` instead.
CLI::Option* add_background(CLI::App& app, const std::string& name, std::optional<Color>& value,
                            bool& is_none, const std::string& description);

/// The same, or `word`, which sets `is_word`.
CLI::Option* add_color_or(CLI::App& app, const std::string& name, std::optional<Color>& value,
                          const std::string& word, bool& is_word, const std::string& description);

/// --device: which Vulkan device to use. The variable RIMLINE_DEVICE is its default. `description` says what for.
CLI::Option* add_device(CLI::App& app, std::string& value, const std::string& description);

struct ImageSize {
    std::uint32_t width, height;
    bool operator==(const ImageSize&) const noexcept = default;
};
constexpr std::uint32_t k_max_image_side = 16384;
/// `WxH`, each from 1 to k_max_image_side. Throws CLI::ValidationError.
ImageSize parse_image_size(const std::string& option, std::string_view text);
CLI::Option* add_image_size(CLI::App& app, const std::string& name, ImageSize& value,
                            const std::string& description);

/// Throws UsageError for the first option that is given of these, which are names of options or of groups of them;
/// `why` says what is missing, after the option's name. The seed is left out: it changes nothing without pictures.
void refuse_options(const CLI::App& app, std::initializer_list<std::string_view> names_or_groups,
                    const std::string& why);

}  // namespace rimline::tools
