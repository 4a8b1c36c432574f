// The rimline program: builds the commands, parses the line, runs one of them, and turns what it throws
// into an exit status and one line on standard error.

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "tools/command.h"
#include "tools/help_formatter.h"
#include "tools/interrupt.h"

namespace {

using rimline::Error;
using rimline::ErrorCode;
using rimline::tools::Command;
using rimline::tools::Context;
using rimline::tools::ExitStatus;
using rimline::tools::UsageError;

constexpr const char* k_footer =
    "MODEL is a file (OBJ, PLY, STL, OFF, glTF, GLB) or shape:NAME[:FACES].\n"
    "rimline SUBCOMMAND --help tells a subcommand's options.\n\n"
    "Examples:\n"
    "  rimline info bunny.obj\n"
    "  rimline silhouette bunny.obj --from 0.3,0.4,0.5 -o lines.svg\n"
    "  rimline track shape:knot:100000 --step 0.5 --verify";

std::vector<std::unique_ptr<Command>> make_commands() {
    std::vector<std::unique_ptr<Command>> commands;
    commands.push_back(rimline::tools::make_render_command());
    commands.push_back(rimline::tools::make_info_command());
    commands.push_back(rimline::tools::make_silhouette_command());
    commands.push_back(rimline::tools::make_track_command());
    commands.push_back(rimline::tools::make_bench_command());
    commands.push_back(rimline::tools::make_devices_command());
    return commands;
}

// Whatever the message holds, it is one line that scripts can find.
ExitStatus report(ExitStatus status, std::string message) {
    while (!message.empty() && message.back() == '\n') message.pop_back();
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::fprintf(stderr, "rimline: error: %s\n", message.c_str());
    return status;
}

ExitStatus report_usage(const std::string& message, const CLI::App& app) {
    const auto parsed = app.get_subcommands();
    const std::string help =
        "rimline " + (parsed.empty() ? "" : parsed.front()->get_name() + " ") + "--help";
    return report(ExitStatus::wrong_usage, message + " (see " + help + ")");
}

ExitStatus run(Command& command, const Context& context) {
    const ExitStatus status = command.run(context);
    // A full disk behind standard output shows only when the buffer is emptied.
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Error(ErrorCode::io,
                    "standard output: cannot write: " + std::generic_category().message(errno));
    return status;
}

ExitStatus parse_and_run(int argc, char** argv, std::stop_token stop) {
    CLI::App app("Finds the silhouettes of 3D models, keeps them up to date, and draws with them.",
                 "rimline");
    app.set_version_flag("--version", "rimline " RIMLINE_VERSION, "Print the version and exit");
    app.set_help_flag("-h,--help", "Print this help and exit");
    app.require_subcommand(0, 1);
    app.footer(k_footer);
    app.formatter(std::make_shared<rimline::tools::HelpFormatter>());

    bool json = false;
    const std::vector<std::unique_ptr<Command>> commands = make_commands();
    for (const auto& command : commands) {
        CLI::App* sub = app.add_subcommand(command->name(), command->summary());
        sub->set_help_flag("-h,--help", "Print this help and exit");
        command->add_options(*sub);
        sub->add_flag("--json", json, "Print one JSON object and nothing else")->group("Output");
    }

    // Before CLI11 takes the --help that follows for the program's own.
    const auto is_first_argument = [&](const auto& c) { return c->name() == argv[1]; };
    if (argc > 1 && argv[1][0] != '-' && std::ranges::none_of(commands, is_first_argument))
        return report_usage("there is no subcommand '" + std::string(argv[1]) + "'", app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) {  // --help and --version arrive as exceptions.
            app.exit(e, std::cout, std::cerr);
            return ExitStatus::success;
        }
        return report_usage(e.what(), app);
    }
    if (app.get_subcommands().empty()) {
        std::string names;
        for (const auto& command : commands) names += " " + command->name();
        std::fprintf(stderr,
                     "usage: rimline SUBCOMMAND [MODEL] [options]\n"
                     "subcommands:%s\n"
                     "rimline --help tells more.\n",
                     names.c_str());
        return ExitStatus::wrong_usage;
    }

    const std::string chosen = app.get_subcommands().front()->get_name();
    const auto command = std::find_if(commands.begin(), commands.end(),
                                      [&](const auto& c) { return c->name() == chosen; });
    try {
        return run(**command, Context{json, std::move(stop)});
    } catch (const UsageError& e) {
        return report_usage(e.what(), app);
    }
}

}  // namespace

int main(int argc, char** argv) {
    ExitStatus status = ExitStatus::failed;
    try {
        status = parse_and_run(argc, argv, rimline::tools::stop_on_interrupt());
    } catch (const Error& e) {
        report(status, e.what());
        if (e.code() == ErrorCode::cancelled) rimline::tools::end_as_interrupted();
    } catch (const std::bad_alloc&) {
        report(status, "out of memory");
    } catch (const std::exception& e) {
        report(status, std::string("unexpected: ") + e.what());
    }
    return static_cast<int>(status);
}
