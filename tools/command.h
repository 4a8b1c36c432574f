#pragma once

// The structure of the program: one Command for each subcommand, one file for each Command.
//
// A command's members are its options. main.cpp builds all commands, adds their options, parses the command
// line, and runs the command that it names. To add a subcommand: derive from Command in commands/<name>.cpp,
// declare its make function below, and list it in main.cpp.

#include <cstddef>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "silhouette/error.h"
#include "tools/cli_classes.h"
#include "tools/run_times.h"

namespace rimline::tools {

/// The name that stands for standard output, where a file is written.
constexpr const char* k_standard_output = "-";

/// The program's exit status. Errors of input and machine are thrown as rimline::Error.
enum class ExitStatus : int {
    success = 0,
    failed = 1,        ///< An input or the machine is at fault.
    wrong_usage = 2,   ///< The command line is at fault.
    check_failed = 3,  ///< --verify or --check found a difference.
};

/// A wrong command line: exit status 2. Throw it from run() for errors that depend on several options.
/// option_types.h reports errors of a single option.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    /// `command`: the one whose --help tells more, such as "draw". Empty: the one that runs.
    UsageError(const std::string& what, std::string command)
        : std::runtime_error(what), command_(std::move(command)) {}

    const std::string& command() const noexcept { return command_; }

private:
    std::string command_;
};

/// The common input of all commands.
struct Context {
    bool json;             ///< Standard output holds one JSON object and nothing else.
    std::stop_token stop;  ///< Set by Ctrl-C.
    /// Of this run. Commands end their steps; what they share ends its own.
    mutable RunTimes times{RunTimes::Clock::now()};

    /// Throws Error{cancelled} after Ctrl-C.
    void checkpoint() const { LongCall{stop, {}}.checkpoint(0.0); }
};

class Command {
public:
    virtual ~Command() = default;

    virtual std::string name() const = 0;
    /// One line, for the list of subcommands.
    virtual std::string summary() const = 0;
    /// Called once, before parsing. main.cpp adds --json, --quiet, --threads and --help, to subcommands of
    /// `app` too.
    virtual void add_options(CLI::App& app) = 0;
    /// Whether it takes what comes after `--`; take_rest() is called with it before run().
    virtual bool takes_rest() const { return false; }
    virtual void take_rest(std::vector<std::string>) {}
    /// Called after parsing.
    virtual ExitStatus run(const Context& context) = 0;
    /// Whether it prints anything with --json. If not, its help does not list the option, and run() refuses it.
    virtual bool has_json() const { return true; }
};

/// Flushes standard output, then writes `message` to standard error as one line; line breaks become spaces, and
/// bytes that cannot be printed are escaped (printable_text.h).
void print_error(std::string_view message);
/// The same for a warning.
void print_warning(std::string_view message);
/// From now on no warnings and no progress are shown (--quiet).
void be_quiet() noexcept;
bool is_quiet() noexcept;
/// Prints `failure`, of a --verify or --check, and returns check_failed. Returns success where it is empty.
ExitStatus report_check(const std::string& failure);

/// Writes to standard output. Throws Error{io} with the reason if the text does not fit into the stream's buffer and
/// cannot be written.
void print_text(std::string_view text);
/// The object on one line. Where a string of it is no UTF-8, bytes of all strings are escaped (printable_text.h).
std::string json_text(const nlohmann::ordered_json& object);
/// Writes json_text() to standard output, as print_text().
void print_json(const nlohmann::ordered_json& object);
/// The same with `times_ms` of the run as its last value.
void print_json(const Context& context, nlohmann::ordered_json object);

/// An array whose elements are made when they are written, because all together would take too much memory.
struct JsonList {
    std::string key;  ///< Of the value in the object that it takes the place of.
    std::size_t count = 0;
    std::function<nlohmann::ordered_json(std::size_t)> element;
};
void print_json(const Context& context, nlohmann::ordered_json object, const JsonList& list);

std::unique_ptr<Command> make_info_command();
std::unique_ptr<Command> make_silhouette_command();
std::unique_ptr<Command> make_draw_command();
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
std::unique_ptr<Command> make_convert_command();
std::unique_ptr<Command> make_batch_command();

}  // namespace rimline::tools
