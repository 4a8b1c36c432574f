#include "tools/output/same_picture.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <string_view>

namespace rimline::tools {

namespace {

// Options that a chosen camera and lights replace, those of other subcommands, and those that change no picture.
constexpr std::array<std::string_view, 28> k_left_out{
    "--eye",     "--target",    "--up",         "--ground-up", "--fov",  "--ortho",
    "--azimuth", "--elevation", "--below",      "--light",     "--sun",  "--output",
    "-k",        "--by-area",   "--no-ratio",   "--json",      "--seed", "--validate",
    "--threads", "MODEL",       "--pass-times", "--at",        "--turn", "--scale",
    "--paint",   "--camera",    "--save-scene", "--verbose"};

}  // namespace

std::string render_command(const CLI::App& app, const std::string& models,
                           const std::vector<std::string>& arguments) {
    std::string command = "rimline render " + models;
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || option->get_positional() ||
            std::ranges::find(k_left_out, name) != k_left_out.end())
            continue;
        if (option->get_expected_max() == 0) {
            command += " " + name;
            continue;
        }
        for (const std::string& value : option->results())
            command += " " + name + (value.starts_with('-') ? "=" : " ") + quoted_for_shell(value);
    }
    for (const std::string& argument : arguments) command += " " + argument;
    return command;
}

}  // namespace rimline::tools
