#pragma once

// --up: which way is up. Where neither the user nor the file format says it, the mesh does
// (silhouette/mesh/upright.h): it is y unless the mesh clearly stands along another axis.

#include <glm/vec3.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/cli_classes.h"

namespace rimline::tools {

/// x, -x, y, ...
std::vector<std::string> axis_names();
/// `x,y,z`, or an axis: x, y, z, -x, -y, -z. Throws CLI::ValidationError.
glm::vec3 parse_up(const std::string& option, const std::string& text);
/// A direction, or an axis: x, y, z, -x, -y, -z. The word `auto` sets `is_auto`.
CLI::Option* add_up(CLI::App& app, std::optional<glm::vec3>& up, bool& is_auto,
                    const std::string& description);
/// The same, with the description of commands that choose as choose_up() does.
CLI::Option* add_up_or_auto(CLI::App& app, std::optional<glm::vec3>& up, bool& is_auto);

/// What options say.
struct UpOptions {
    std::optional<glm::vec3> up;         ///< In the picture.
    bool is_up_auto = false;             ///< --up auto.
    std::optional<glm::vec3> ground_up;  ///< Of what stands on the ground. Not set: `up`.
};

struct ChosenUp {
    enum class Source {
        option,
        format,   ///< The file format, or the built-in shape.
        mesh,     ///< The mesh stands along another axis than y.
        assumed,  ///< y.
    };
    glm::dvec3 up{0, 1, 0};
    Source source = Source::assumed;
};

/// What add_up_or_auto() and the mesh say. Throws Error{cancelled} when `stop` is requested.
ChosenUp choose_up(const Mesh& mesh, const std::optional<glm::vec3>& up, bool is_auto,
                   const std::stop_token& stop = {});
/// The same, and stores it in `up`.
ChosenUp settle_up(const Mesh& mesh, std::optional<glm::vec3>& up, bool is_auto,
                   const std::stop_token& stop = {});

/// "option", "format", "mesh" or "assumed".
const char* up_source_name(ChosenUp::Source source);
/// As --up takes it: "z", "-y". Empty for a direction along no axis.
std::string axis_name(const glm::dvec3& up);
/// One line that says how to overrule a choice by the mesh. Prints nothing for other choices.
void print_up(const ChosenUp& chosen);

}  // namespace rimline::tools
