// A command line, one argument a line, as far as it is read before a model is: either it is understood, or there is
// a message of one line.

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_input.h"
#include "tools/command.h"
#include "tools/usage_words.h"

using namespace rimline;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> arguments(1);
    for (std::size_t i = 0; i < size; ++i) {
        if (data[i] == '\n')
            arguments.emplace_back();
        else if (data[i] != '\0')  // No argument of a program holds one.
            arguments.back() += static_cast<char>(data[i]);
    }
    CLI::App app("", "rimline");
    std::vector<std::unique_ptr<tools::Command>> commands;
    commands.push_back(tools::make_info_command());
    commands.push_back(tools::make_silhouette_command());
    commands.push_back(tools::make_draw_command());
    commands.push_back(tools::make_track_command());
    commands.push_back(tools::make_origins_command());
    commands.push_back(tools::make_field_command());
    commands.push_back(tools::make_points_command());
    commands.push_back(tools::make_convert_command());
    for (const auto& command : commands)
        command->add_options(*app.add_subcommand(command->name(), command->summary()));
    std::ranges::reverse(arguments);
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0)
            fuzz::require(!tools::first_usage_words(error, app).empty(), "an error without words");
    }
    return 0;
}
