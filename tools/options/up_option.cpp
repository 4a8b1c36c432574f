#include "tools/options/up_option.h"

#include <CLI/App.hpp>
#include <array>
#include <cstdio>
#include <string_view>

#include "silhouette/mesh/upright.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

// By k_axis_directions.
constexpr std::array<std::string_view, 6> k_axis_names{"x", "-x", "y", "-y", "z", "-z"};

}  // namespace

std::vector<std::string> axis_names() { return {k_axis_names.begin(), k_axis_names.end()}; }

glm::vec3 parse_up(const std::string& option, const std::string& text) {
    for (std::size_t i = 0; i < k_axis_names.size(); ++i)
        if (text == k_axis_names[i]) return glm::vec3(k_axis_directions[i]);
    if (text.find(',') == std::string::npos)
        throw CLI::ValidationError(
            option, "expected three numbers x,y,z or one of x, y, z, -x, -y, -z" +
                        std::string(option == "--up" ? ", auto" : "") + ", not '" + text + "'");
    return parse_direction(option, text);
}

CLI::Option* add_up(CLI::App& app, std::optional<glm::vec3>& up, bool& is_auto,
                    const std::string& description) {
    return app
        .add_option_function<std::string>(
            "--up",
            [&up, &is_auto](const std::string& text) {
                is_auto = text == "auto";
                if (!is_auto) up = parse_up("--up", text);
            },
            description)
        ->type_name("X,Y,Z|AXIS|auto");
}

CLI::Option* add_up_or_auto(CLI::App& app, std::optional<glm::vec3>& up, bool& is_auto) {
    return add_up(
        app, up, is_auto,
        "Up direction: X,Y,Z, one of x, y, z, -x, -y, -z, or auto: y, unless the model "
        "clearly stands along another axis (default: as the file format says, else auto)");
}

ChosenUp choose_up(const Mesh& mesh, const std::optional<glm::vec3>& up, bool is_auto,
                   const std::stop_token& stop) {
    if (up) return {glm::dvec3(*up), ChosenUp::Source::option};
    if (mesh.is_up_known() && !is_auto) return {direction_of(mesh.up()), ChosenUp::Source::format};
    const glm::dvec3 upright = choose_upright(mesh, stop);
    const bool is_y = upright == glm::dvec3(0, 1, 0);
    return {upright, is_y ? ChosenUp::Source::assumed : ChosenUp::Source::mesh};
}

ChosenUp settle_up(const Mesh& mesh, std::optional<glm::vec3>& up, bool is_auto,
                   const std::stop_token& stop) {
    const ChosenUp chosen = choose_up(mesh, up, is_auto, stop);
    up = glm::vec3(chosen.up);
    return chosen;
}

const char* up_source_name(ChosenUp::Source source) {
    switch (source) {
        case ChosenUp::Source::option: return "option";
        case ChosenUp::Source::format: return "format";
        case ChosenUp::Source::mesh: return "mesh";
        case ChosenUp::Source::assumed: return "assumed";
    }
    return "";
}

std::string axis_name(const glm::dvec3& up) {
    for (std::size_t i = 0; i < k_axis_names.size(); ++i)
        if (up == k_axis_directions[i]) return std::string(k_axis_names[i]);
    return "";
}

void print_up(const ChosenUp& chosen) {
    if (chosen.source == ChosenUp::Source::mesh)
        std::printf("  up          %s, along which the model stands; --up y keeps it as it is\n",
                    axis_name(chosen.up).c_str());
}

}  // namespace rimline::tools
