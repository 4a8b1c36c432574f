#pragma once

// The values that options take, and their strict readers: what is not exactly such a value is a usage
// error that names the option, says what was expected and shows what stood there.
//
// The add_ functions follow CLI11's own: the option writes into `value`, which must outlive parsing, and
// returns the option so that the caller can group it.

#include <CLI/App.hpp>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rimline::tools {

/// Three finite numbers `x,y,z`, each within k_max_coordinate, with blanks around them or not. Throws
/// CLI::ValidationError.
glm::vec3 parse_point(const std::string& option, std::string_view text);
/// The same in double, for clouds far from zero.
glm::dvec3 parse_exact_point(const std::string& option, std::string_view text);
/// The same, and not zero: components below k_min_point_component count as zero.
glm::vec3 parse_direction(const std::string& option, std::string_view text);

CLI::Option* add_point(CLI::App& app, const std::string& name, std::optional<glm::vec3>& value,
                       const std::string& description);
CLI::Option* add_exact_point(CLI::App& app, const std::string& name,
                             std::optional<glm::dvec3>& value, const std::string& description);
CLI::Option* add_direction(CLI::App& app, const std::string& name, std::optional<glm::vec3>& value,
                           const std::string& description);
/// Options that may be given several times.
CLI::Option* add_points(CLI::App& app, const std::string& name, std::vector<glm::vec3>& values,
                        const std::string& description);
CLI::Option* add_directions(CLI::App& app, const std::string& name, std::vector<glm::vec3>& values,
                            const std::string& description);

/// The same, where the word `auto` sets `is_auto` and adds none.
CLI::Option* add_directions_or_auto(CLI::App& app, const std::string& name,
                                    std::vector<glm::vec3>& values, bool& is_auto,
                                    const std::string& description);

/// A finite number in [low, high]; `value` holds the default, shown in the help.
CLI::Option* add_number(CLI::App& app, const std::string& name, double& value, double low,
                        double high, const std::string& description);
/// The same without a default.
CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& value,
                        double low, double high, const std::string& description);
/// A whole number in [low, high]; `value` holds the default, shown in the help.
CLI::Option* add_count(CLI::App& app, const std::string& name, std::uint32_t& value,
                       std::uint32_t low, std::uint32_t high, const std::string& description);

/// The name of a file to write, which ends in `ending`, as ".png", in any case; of a device, a pipe or a link
/// in /dev, as /dev/stdout, it may be any. `value` holds the default; empty when there is none.
CLI::Option* add_output(CLI::App& app, const std::string& name, std::string& value,
                        const std::string& ending, const std::string& description);

/// sRGB, 8 bits a channel.
struct Color {
    std::uint8_t red, green, blue;
};
/// `#rrggbb` or one of the names that the help lists.
CLI::Option* add_color(CLI::App& app, const std::string& name, std::optional<Color>& value,
                       const std::string& description);

struct ImageSize {
    std::uint32_t width, height;
};
constexpr std::uint32_t k_max_image_side = 16384;
/// `WxH`, each from 1 to k_max_image_side.
CLI::Option* add_image_size(CLI::App& app, const std::string& name, ImageSize& value,
                            const std::string& description);

}  // namespace rimline::tools
