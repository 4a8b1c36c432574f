#include "tools/options/option_types.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <system_error>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "tools/command.h"
#include "tools/nearest_name.h"

namespace rimline::tools {

namespace fs = std::filesystem;

namespace {

std::string_view without_blanks(std::string_view text) {
    constexpr std::string_view k_blanks = " \t";
    const std::size_t first = text.find_first_not_of(k_blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(k_blanks) - first + 1);
}

// The number if all of `text` is one finite number of this type.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
    // std::from_chars accepts no leading plus.
    if constexpr (std::is_floating_point_v<Number>)
        if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>)
        if (!std::isfinite(value)) return std::nullopt;
    return value;
}

[[noreturn]] void reject(const std::string& option, const std::string& expected,
                         std::string_view text, const std::string& advice = {}) {
    throw CLI::ValidationError(
        option, "expected " + expected + ", not '" + std::string(text) + "'" + advice);
}

std::string plain(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.15g", value);
    return text.data();
}

// An option whose text is parsed by `read`.
CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& type,
                      const std::string& description,
                      const std::function<void(const std::string&)>& read) {
    return app.add_option_function<std::string>(name, read, description)->type_name(type);
}

CLI::Option* add_repeatable(CLI::App& app, const std::string& name, const std::string& type,
                            const std::string& description,
                            const std::function<void(const std::string&)>& read) {
    return app
        .add_option_function<std::vector<std::string>>(
            name,
            [read](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) read(text);
            },
            description)
        ->type_name(type)
        // Otherwise the option would take a following MODEL as another value.
        ->allow_extra_args(false);
}

// `ending` must be in lower case.
bool ends_in(std::string_view text, std::string_view ending) {
    return text.size() >= ending.size() &&
           std::ranges::equal(text.substr(text.size() - ending.size()), ending, {},
                              [](char c) { return std::tolower(static_cast<unsigned char>(c)); });
}

// Includes links in /dev: the shell, not the user's argument, named the target of /dev/stdout.
bool is_device_or_pipe(const std::string& file_name) {
    std::error_code ignored;
    if (file_name.starts_with("/dev/") && fs::is_symlink(file_name, ignored)) return true;
    return fs::exists(file_name, ignored) && !fs::is_regular_file(file_name, ignored);
}

constexpr const char* k_color_forms = "#rgb, #rrggbb or a CSS color name";

// A color with alpha is one only where `takes_alpha`.
Color parse_color(const std::string& option, std::string_view text, bool takes_alpha) {
    const std::optional<Color> color = color_of(text);
    const std::string forms = takes_alpha ? "none, #rgb, #rrggbb, #rrggbbaa or a CSS color name"
                                          : std::string(k_color_forms);
    if (!color)
        throw CLI::ValidationError(option, "expected " + forms + ", not '" + std::string(text) +
                                               "'" + nearest_color(text));
    if (!takes_alpha && color->alpha != 255)
        throw CLI::ValidationError(option,
                                   "expected a color without alpha, not '" + std::string(text) +
                                       "': only --background of a picture can be transparent");
    return *color;
}

// `word`: what may stand there as well.
double parse_in_range(const std::string& option, const std::string& text, double low, double high,
                      const std::string& word = {}) {
    const std::optional<double> number = parse_number<double>(text);
    if (!number || *number < low || *number > high)
        reject(option,
               "a number from " + plain(low) + " to " + plain(high) +
                   (word.empty() ? "" : ", or " + word),
               text);
    return *number;
}

}  // namespace

ImageSize parse_image_size(const std::string& option, std::string_view text) {
    const std::size_t cross = text.find('x');
    if (cross != std::string_view::npos) {
        const auto width = parse_number<std::uint32_t>(text.substr(0, cross));
        const auto height = parse_number<std::uint32_t>(text.substr(cross + 1));
        const auto fits = [](const auto& side) {
            return side && *side >= 1 && *side <= k_max_image_side;
        };
        if (fits(width) && fits(height)) return {*width, *height};
    }
    reject(option, "WxH with both from 1 to " + std::to_string(k_max_image_side), text);
}

glm::dvec3 parse_exact_point(const std::string& option, std::string_view text) {
    glm::dvec3 point{};
    std::string_view rest = text;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t comma = rest.find(',');
        if ((comma == std::string_view::npos) != (axis == 2))
            reject(option, "three numbers x,y,z", text);
        const std::optional<double> number =
            parse_number<double>(without_blanks(rest.substr(0, comma)));
        if (!number) reject(option, "three finite numbers x,y,z", text);
        if (std::abs(*number) > double{k_max_coordinate})
            reject(option, "coordinates of at most 2^60, about 1.15e18", text);
        point[axis] = *number;
        if (axis < 2) rest.remove_prefix(comma + 1);
    }
    return point;
}

glm::vec3 parse_point(const std::string& option, std::string_view text) {
    return glm::vec3(parse_exact_point(option, text));
}

std::optional<glm::dvec3> in_double(const std::optional<glm::vec3>& point) {
    return point ? std::optional(glm::dvec3(*point)) : std::nullopt;
}

glm::vec3 parse_direction(const std::string& option, std::string_view text) {
    const glm::vec3 direction = parse_point(option, text);
    if (HomogeneousPoint::direction(direction).xyz() == glm::vec3(0.0f))
        reject(option, "a direction that is not zero (components below 2^-60 count as zero)", text);
    return direction;
}

CLI::Option* add_point(CLI::App& app, const std::string& name, std::optional<glm::vec3>& value,
                       const std::string& description) {
    return add_text(app, name, "X,Y,Z", description,
                    [name, &value](const std::string& text) { value = parse_point(name, text); });
}

CLI::Option* add_exact_point(CLI::App& app, const std::string& name,
                             std::optional<glm::dvec3>& value, const std::string& description) {
    return add_text(app, name, "X,Y,Z", description, [name, &value](const std::string& text) {
        value = parse_exact_point(name, text);
    });
}

CLI::Option* add_direction(CLI::App& app, const std::string& name, std::optional<glm::vec3>& value,
                           const std::string& description) {
    return add_text(app, name, "X,Y,Z", description, [name, &value](const std::string& text) {
        value = parse_direction(name, text);
    });
}

CLI::Option* add_points(CLI::App& app, const std::string& name, std::vector<glm::vec3>& values,
                        const std::string& description) {
    return add_repeatable(
        app, name, "X,Y,Z", description,
        [name, &values](const std::string& text) { values.push_back(parse_point(name, text)); });
}

CLI::Option* add_directions(CLI::App& app, const std::string& name, std::vector<glm::vec3>& values,
                            const std::string& description) {
    return add_repeatable(app, name, "X,Y,Z", description,
                          [name, &values](const std::string& text) {
                              values.push_back(parse_direction(name, text));
                          });
}

CLI::Option* add_directions_or_auto(CLI::App& app, const std::string& name,
                                    std::vector<glm::vec3>& values, bool& is_auto,
                                    const std::string& description) {
    return add_repeatable(app, name, "X,Y,Z|auto", description,
                          [name, &values, &is_auto](const std::string& text) {
                              is_auto = is_auto || text == "auto";
                              if (text == "auto") return;
                              if (text.find(',') == std::string::npos)
                                  reject(name, "three numbers x,y,z or auto", text);
                              values.push_back(parse_direction(name, text));
                          });
}

CLI::Option* add_number(CLI::App& app, const std::string& name, double& value, double low,
                        double high, const std::string& description) {
    return add_text(app, name, "NUMBER", description,
                    [=, &value](const std::string& text) {
                        value = parse_in_range(name, text, low, high);
                    })
        ->default_str(plain(value));
}

CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& value,
                        double low, double high, const std::string& description) {
    return add_text(app, name, "NUMBER", description, [=, &value](const std::string& text) {
        value = parse_in_range(name, text, low, high);
    });
}

CLI::Option* add_number_or(CLI::App& app, const std::string& name, std::optional<double>& value,
                           double low, double high, const std::string& word, bool& is_word,
                           const std::string& description) {
    return add_text(
        app, name, "NUMBER|" + word, description, [=, &value, &is_word](const std::string& text) {
            is_word = text == word;
            value =
                is_word ? std::nullopt : std::optional(parse_in_range(name, text, low, high, word));
        });
}

CLI::Option* add_count(CLI::App& app, const std::string& name, std::uint32_t& value,
                       std::uint32_t low, std::uint32_t high, const std::string& description) {
    return add_text(app, name, "N", description,
                    [=, &value](const std::string& text) {
                        const auto number = parse_number<std::uint32_t>(text);
                        if (!number || *number < low || *number > high)
                            reject(name,
                                   "a whole number from " + std::to_string(low) + " to " +
                                       std::to_string(high),
                                   text);
                        value = *number;
                    })
        ->default_str(std::to_string(value));
}

CLI::Option* add_output(CLI::App& app, const std::string& name, std::string& value,
                        const std::string& ending, const std::string& description) {
    const std::string type = "FILE" + ending;
    return add_text(app, name, type, description,
                    [=, &value](const std::string& text) {
                        if (text != k_standard_output && !ends_in(text, ending) &&
                            !is_device_or_pipe(text))
                            reject(name.substr(0, name.find(',')), type, text);
                        value = text;
                    })
        ->default_str(value);
}

CLI::Option* add_color(CLI::App& app, const std::string& name, std::optional<Color>& value,
                       const std::string& description) {
    return add_text(
        app, name, "COLOR", description + ": " + k_color_forms,
        [name, &value](const std::string& text) { value = parse_color(name, text, false); });
}

CLI::Option* add_background(CLI::App& app, const std::string& name, std::optional<Color>& value,
                            bool& is_none, const std::string& description) {
    return add_text(app, name, "COLOR|none",
                    description +
                        ": #rgb, #rrggbb, #rrggbbaa, a CSS color name, or none: "
                        "transparent",
                    [name, &value, &is_none](const std::string& text) {
                        is_none = text == "none" || text == "transparent";
                        if (!is_none) value = parse_color(name, text, true);
                    });
}

CLI::Option* add_color_or(CLI::App& app, const std::string& name, std::optional<Color>& value,
                          const std::string& word, bool& is_word, const std::string& description) {
    return add_text(app, name, "COLOR|" + word, description + ". Color: " + k_color_forms,
                    [name, word, &value, &is_word](const std::string& text) {
                        is_word = text == word;
                        if (is_word) return;
                        const std::string nearest = did_you_mean(text, std::vector{word});
                        if (!nearest.empty() && !color_of(text))
                            reject(name, std::string(k_color_forms) + ", or " + word, text,
                                   nearest);
                        value = parse_color(name, text, false);
                    });
}

CLI::Option* add_image_size(CLI::App& app, const std::string& name, ImageSize& value,
                            const std::string& description) {
    return add_text(
               app, name, "WxH", description,
               [name, &value](const std::string& text) { value = parse_image_size(name, text); })
        ->default_str(std::to_string(value.width) + "x" + std::to_string(value.height));
}

CLI::Option* add_device(CLI::App& app, std::string& value, const std::string& description) {
    return app.add_option("--device", value, description)
        ->envname("RIMLINE_DEVICE")
        ->type_name("DEVICE")
        ->group("Machine");
}

void refuse_options(const CLI::App& app, std::initializer_list<std::string_view> names_or_groups,
                    const std::string& why) {
    const auto is_named = [&](const std::string& text) {
        return std::ranges::find(names_or_groups, text) != names_or_groups.end();
    };
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        // What the environment says is for the commands that take it.
        const std::string variable = option->get_envname();
        const char* const set = variable.empty() ? nullptr : std::getenv(variable.c_str());
        if (set != nullptr && option->results() == std::vector<std::string>{set}) continue;
        if (option->count() > 0 && name != "--seed" &&
            (is_named(name) || is_named(option->get_group())))
            throw UsageError(name + ": " + why);
    }
}

}  // namespace rimline::tools
