#pragma once

// The frame of the program: one Command a subcommand, one file a Command.
//
// A command's members are its options. main.cpp builds all commands, lets each add its options, parses,
// and runs the one that was named. To add a subcommand: derive from Command in <name>.cpp, declare its
// make function below, list it in main.cpp.

#include <CLI/App.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <stop_token>
#include <string>

#include "silhouette/error.h"

namespace rimline::tools {

/// The program's exit status. Errors of input and machine are thrown as rimline::Error.
enum class ExitStatus : int {
    success = 0,
    failed = 1,        ///< An input or the machine is at fault.
    wrong_usage = 2,   ///< The command line is at fault.
    check_failed = 3,  ///< --verify or --check found a difference.
};

/// The command line asks for what cannot be: exit status 2. Throw it from run() for what can only be
/// known when all options are read; option_types.h reports what is wrong with one option alone.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What the frame knows and every command needs.
struct Context {
    bool json;             ///< Standard output holds one JSON object and nothing else.
    std::stop_token stop;  ///< Set by Ctrl-C.

    /// Throws Error{cancelled} after Ctrl-C.
    void checkpoint() const { LongCall{stop, {}}.checkpoint(0.0); }
};

class Command {
public:
    virtual ~Command() = default;

    virtual std::string name() const = 0;
    /// One line, for the list of subcommands.
    virtual std::string summary() const = 0;
    /// Called once, before parsing. The frame adds --json and --help.
    virtual void add_options(CLI::App& app) = 0;
    /// Called when everything is parsed.
    virtual ExitStatus run(const Context& context) = 0;
};

/// Writes `message` to standard error, in one line that scripts can find, whatever it holds; behind what was
/// written to standard output.
void print_error(std::string message);
/// The status of a --verify or --check that failed as `failure` says, which is printed; success where it is
/// empty.
ExitStatus report_check(const std::string& failure);

/// Writes one JSON object to standard output. Bytes of file names that are not UTF-8 are replaced.
void print_json(const nlohmann::ordered_json& object);

std::unique_ptr<Command> make_info_command();
std::unique_ptr<Command> make_silhouette_command();
std::unique_ptr<Command> make_track_command();
std::unique_ptr<Command> make_origins_command();
std::unique_ptr<Command> make_field_command();
std::unique_ptr<Command> make_points_command();
std::unique_ptr<Command> make_bench_command();
std::unique_ptr<Command> make_render_command();
std::unique_ptr<Command> make_animate_command();
std::unique_ptr<Command> make_devices_command();
std::unique_ptr<Command> make_view_command();
std::unique_ptr<Command> make_views_command();
std::unique_ptr<Command> make_path_command();
std::unique_ptr<Command> make_light_command();

}  // namespace rimline::tools
