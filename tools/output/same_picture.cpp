#include "tools/output/same_picture.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

namespace rimline::tools {

namespace {

// Options that a chosen camera and lights replace, those of other subcommands, and those that change no picture.
constexpr std::array<std::string_view, 27> k_left_out{
    "--eye",       "--target", "--up",    "--ground-up", "--fov",     "--ortho",     "--azimuth",
    "--elevation", "--below",  "--light", "--sun",       "--output",  "-k",          "--by-area",
    "--no-ratio",  "--json",   "--seed",  "--validate",  "--threads", "MODEL",       "--pass-times",
    "--at",        "--turn",   "--scale", "--paint",     "--camera",  "--save-scene"};

template <typename Number>
std::string shortest(Number value) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

}  // namespace

std::string exact_text(float value) {
    const std::string text = shortest(value);
    double parsed = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), parsed);
    // Both roundings together may differ from one.
    return float(parsed) == value ? text : exact_text(double{value});
}

std::string exact_text(double value) { return shortest(value); }

std::string quoted_for_shell(const std::string& text) {
    constexpr std::string_view k_plain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_@%+=:,./-";
    if (!text.empty() && text.find_first_not_of(k_plain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

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
