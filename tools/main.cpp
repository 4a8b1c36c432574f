// The rimline program. It builds the commands, parses the command line and runs one command. It reports an
// exception as an exit status and one line on standard error.

#include <tbb/global_control.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "tools/command.h"
#include "tools/help_formatter.h"
#include "tools/manual_page.h"
#include "tools/nearest_name.h"
#include "tools/option_table.h"
#include "tools/options/offered_values.h"
#include "tools/options/option_types.h"
#include "tools/output/leftover.h"
#include "tools/output/summary_stream.h"
#include "tools/process/end_with_parent.h"
#include "tools/process/freed_memory.h"
#include "tools/process/interrupt.h"
#include "tools/process/standard_descriptors.h"
#include "tools/process/thread_limit.h"
#include "tools/run_times.h"
#include "tools/shell_completion.h"
#include "tools/usage_words.h"

namespace {

using rimline::Error;
using rimline::ErrorCode;
using rimline::tools::Command;
using rimline::tools::Context;
using rimline::tools::ExitStatus;
using rimline::tools::print_error;
using rimline::tools::UsageError;

constexpr const char* k_version = "rimline " RIMLINE_VERSION;
constexpr const char* k_json_description = "Print one JSON object and nothing else";
constexpr const char* k_quiet_description = "Print no summary, warnings or progress";
constexpr const char* k_footer =
    "MODEL is a file (OBJ, PLY, STL, OFF, glTF, GLB) or shape:NAME[:FACES].\n"
    "rimline SUBCOMMAND --help lists a subcommand's options.\n\n"
    "Examples:\n"
    "  rimline render                     (draws a picture, rimline.png, without any model)\n"
    "  rimline render bunny.obj -o bunny.png\n"
    "  rimline info bunny.obj\n"
    "  rimline draw bunny.obj -o bunny.svg\n"
    "  rimline silhouette bunny.obj --from 0.3,0.4,0.5 -o lines.svg\n"
    "  rimline track shape:knot:100000 --step 0.5 --verify";

std::vector<std::unique_ptr<Command>> make_commands() {
    std::vector<std::unique_ptr<Command>> commands;
    commands.push_back(rimline::tools::make_render_command());
    commands.push_back(rimline::tools::make_animate_command());
    commands.push_back(rimline::tools::make_info_command());
    commands.push_back(rimline::tools::make_silhouette_command());
    commands.push_back(rimline::tools::make_draw_command());
    commands.push_back(rimline::tools::make_track_command());
    commands.push_back(rimline::tools::make_views_command());
    commands.push_back(rimline::tools::make_path_command());
    commands.push_back(rimline::tools::make_light_command());
    commands.push_back(rimline::tools::make_origins_command());
    commands.push_back(rimline::tools::make_field_command());
    commands.push_back(rimline::tools::make_points_command());
    commands.push_back(rimline::tools::make_convert_command());
    commands.push_back(rimline::tools::make_batch_command());
    commands.push_back(rimline::tools::make_bench_command());
    commands.push_back(rimline::tools::make_view_command());
    commands.push_back(rimline::tools::make_devices_command());
    return commands;
}

// The arguments after the program's name, where `help` and `help SUBCOMMAND` stand for --help.
std::vector<std::string> arguments_of(int argc, char** argv) {
    std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    if (arguments.empty() || arguments.front() != "help") return arguments;
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
    return arguments;
}

// Makes names of the arguments after `--` and removes it: what begins with a dash then begins with "./", which names
// the same file. A lone dash stays standard input. Returns whether a name was changed.
bool take_names(std::vector<std::string>& arguments, std::vector<std::string>::iterator dashes) {
    bool has_changed = false;
    for (auto name = arguments.erase(dashes); name != arguments.end(); ++name) {
        if (name->size() < 2 || !name->starts_with('-')) continue;
        name->insert(0, "./");
        has_changed = true;
    }
    return has_changed;
}

// `command`: the one whose help tells more; empty: the one that was parsed.
ExitStatus report_usage(const std::string& message, const CLI::App& app,
                        const std::string& command = {}) {
    std::string help;
    if (command.empty())
        for (const CLI::App* named : rimline::tools::parsed_chain(app))
            help += named->get_name() + " ";
    else
        help = app.get_name() + " " + command + " ";
    print_error(message + " (see " + help + "--help)");
    return ExitStatus::wrong_usage;
}

// A full disk is reported only when the buffer of standard output is flushed. After an earlier write that failed, the
// reason is no longer known.
void flush_output() {
    errno = 0;
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
    throw Error(ErrorCode::io,
                "standard output: cannot write" +
                    (errno == 0 ? " all of it" : ": " + std::generic_category().message(errno)));
}

// The script for a shell, or the manual page for none.
std::string document(const rimline::tools::CommandRow& table, const std::string& shell) {
    if (shell == "bash") return rimline::tools::bash_completion(table);
    if (shell == "zsh") return rimline::tools::zsh_completion(table);
    if (shell == "fish") return rimline::tools::fish_completion(table);
    return rimline::tools::manual_page(table, RIMLINE_VERSION);
}

// The program's commands and options, and the values that the arguments give them.
class Program {
public:
    Program();

    // Parses the arguments after the program's name and does what they ask for.
    ExitStatus run(std::vector<std::string> arguments, std::stop_token stop);

private:
    void add_shared_options(CLI::App& sub, bool has_json);
    std::optional<ExitStatus> parse(std::vector<std::string> arguments);
    // The name of a subcommand after other words, none of which is --. Empty if there is none.
    std::string undivided_rest(const std::vector<std::string>& words) const;
    ExitStatus report_parse_error(const CLI::ParseError& error, bool has_dashed_names);
    ExitStatus print(const std::string& text);
    ExitStatus run_command(std::stop_token stop);
    void limit_threads() const;
    std::vector<std::unique_ptr<Command>>::const_iterator command_of(const std::string& name) const;
    std::vector<std::string> names() const;

    rimline::tools::RunTimes::Clock::time_point started_ = rimline::tools::RunTimes::Clock::now();
    CLI::App app_{"Finds the silhouettes of 3D models, keeps them up to date, and draws with them.",
                  "rimline"};
    std::vector<std::unique_ptr<Command>> commands_ = make_commands();
    rimline::tools::CommandRow table_;  // Of all options.
    bool json_ = false;
    bool quiet_ = false;
    bool verbose_ = false;
    std::uint32_t threads_ = 0;  // 0: all.
    std::string completion_;
    bool wants_manual_ = false;
};

Program::Program() {
    app_.set_version_flag("--version", k_version, "Print the version and exit");
    app_.set_help_flag("-h,--help", "Print this help and exit");
    app_.require_subcommand(0, 1);
    app_.footer(k_footer);
    app_.formatter(std::make_shared<rimline::tools::HelpFormatter>());
    for (const auto& command : commands_) {
        CLI::App* sub = app_.add_subcommand(command->name(), command->summary());
        sub->set_help_flag("-h,--help", "Print this help and exit");
        command->add_options(*sub);
        add_shared_options(*sub, command->has_json());
        for (CLI::App* nested : sub->get_subcommands([](CLI::App*) { return true; }))
            add_shared_options(*nested, command->has_json());
    }
    app_.add_option("--completion", completion_, "Print a script that completes rimline in a shell")
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    app_.add_flag("--manual", wants_manual_, "Print the manual page, for man -l -");
    app_.add_flag("--json", json_, k_json_description);
    app_.add_flag("--quiet", quiet_, k_quiet_description);
    table_ = rimline::tools::option_table(app_, rimline::tools::offered_values);
}

void Program::add_shared_options(CLI::App& sub, bool has_json) {
    sub.add_flag("--json", json_, k_json_description)->group(has_json ? "Output" : "");
    sub.add_flag("--quiet", quiet_, k_quiet_description)->group("Output");
    sub.add_flag("--verbose", verbose_, "Print to standard error where the time went")
        ->group("Output");
    rimline::tools::add_count(sub, "--threads", threads_, 1, 1024,
                              "Threads of the parallel parts (default: all)")
        ->default_str("")
        ->group("Machine");
    // Works everywhere. Only the program's own help lists it.
    sub.set_version_flag("--version", k_version)->group("");
}

std::vector<std::unique_ptr<Command>>::const_iterator Program::command_of(
    const std::string& name) const {
    return std::ranges::find_if(commands_,
                                [&](const auto& command) { return command->name() == name; });
}

std::vector<std::string> Program::names() const {
    std::vector<std::string> names;
    for (const auto& command : commands_) names.push_back(command->name());
    return names;
}

ExitStatus Program::print(const std::string& text) {
    rimline::tools::print_text(text);
    flush_output();
    return ExitStatus::success;
}

// Returns a status where no command is to be run.
std::optional<ExitStatus> Program::parse(std::vector<std::string> arguments) {
    // Checked first: CLI11 would take a following --help as the program's own.
    const auto first = std::ranges::find_if_not(
        arguments, [](const std::string& argument) { return argument.starts_with('-'); });
    // The value of --completion is no subcommand.
    const bool has_value = first != arguments.begin() && first != arguments.end() &&
                           *std::prev(first) == "--completion";
    bool has_dashed_names = false;
    std::string undivided;
    if (first != arguments.end() && !has_value) {
        const auto command = command_of(*first);
        if (command == commands_.end())
            return report_usage("there is no subcommand '" + *first + "'" +
                                    rimline::tools::did_you_mean(*first, names()),
                                app_);
        const auto rest = std::find(first, arguments.end(), "--");
        if (rest != arguments.end() && (*command)->takes_rest()) {
            (*command)->take_rest({std::next(rest), arguments.end()});
            arguments.erase(rest, arguments.end());
        } else if (rest != arguments.end()) {
            has_dashed_names = take_names(arguments, rest);
        } else if ((*command)->takes_rest()) {
            undivided = undivided_rest({std::next(first), arguments.end()});
        }
    }
    std::ranges::reverse(arguments);  // The order that CLI11 expects.
    try {
        app_.parse(std::move(arguments));
    } catch (const CLI::ParseError& e) {
        if (undivided.empty() || e.get_exit_code() == 0)
            return report_parse_error(e, has_dashed_names);
    }
    if (undivided.empty()) return std::nullopt;
    return report_usage("-- is missing before the subcommand '" + undivided + "'", app_);
}

std::string Program::undivided_rest(const std::vector<std::string>& words) const {
    for (std::size_t i = 1; i < words.size(); ++i)
        if (command_of(words[i]) != commands_.end() && !words[i - 1].starts_with('-'))
            return words[i];
    return {};
}

ExitStatus Program::report_parse_error(const CLI::ParseError& error, bool has_dashed_names) {
    if (error.get_exit_code() == 0) {  // --help and --version arrive as exceptions.
        std::ostringstream text;
        app_.exit(error, text, text);
        return print(text.str());
    }
    const bool lacks_option = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                              dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    const char* advice =
        has_dashed_names && lacks_option ? "; what follows -- are names, no options" : "";
    return report_usage(rimline::tools::first_usage_words(error, app_) + advice, app_);
}

ExitStatus Program::run(std::vector<std::string> arguments, std::stop_token stop) {
    if (const std::optional<ExitStatus> status = parse(std::move(arguments))) return *status;
    if (!completion_.empty() || wants_manual_) return print(document(table_, completion_));
    if (!app_.get_subcommands().empty()) return run_command(std::move(stop));
    std::string words;
    for (const std::string& name : names()) words += " " + name;
    std::fprintf(stderr,
                 "usage: rimline SUBCOMMAND [MODEL] [options]\n"
                 "subcommands:%s\n"
                 "rimline render alone draws a picture, rimline.png; rimline --help tells "
                 "more.\n",
                 words.c_str());
    return ExitStatus::wrong_usage;
}

void Program::limit_threads() const {
    const std::uint32_t wanted = threads_ > 0 ? threads_ : rimline::tools::usual_threads();
    const std::uint32_t startable = rimline::tools::startable_threads(wanted);
    // Never destroyed: oneTBB would start the threads that it was kept from when this ends.
    alignas(tbb::global_control) static std::byte at_most[sizeof(tbb::global_control)];
    if (threads_ > 0 || startable < wanted)
        new (at_most) tbb::global_control(tbb::global_control::max_allowed_parallelism, startable);
    rimline::tools::start_threads_before_memory_is_taken(startable);
}

ExitStatus Program::run_command(std::stop_token stop) {
    limit_threads();
    if (quiet_) rimline::tools::be_quiet();
    if (quiet_ && !json_) rimline::tools::drop_summary();
    try {
        const Context context{
            .json = json_, .stop = std::move(stop), .times = rimline::tools::RunTimes(started_)};
        const auto command = command_of(app_.get_subcommands().front()->get_name());
        const ExitStatus status = (*command)->run(context);
        flush_output();
        context.times.end("the rest");
        if (verbose_) std::fputs(context.times.table().c_str(), stderr);
        return status;
    } catch (const UsageError& e) {
        return report_usage(e.what(), app_, e.command());
    }
}

// Throws only where there is no memory for the words.
ExitStatus run_and_report(int argc, char** argv) {
    try {
        return Program().run(arguments_of(argc, argv),
                             rimline::tools::stop_on_interrupt(rimline::tools::remove_leftovers));
    } catch (const Error& e) {
        if (e.code() == ErrorCode::cancelled) rimline::tools::end_as_interrupted();
        print_error(e.what());
        if (e.code() == ErrorCode::io) rimline::tools::end_as_write_failed();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        print_error(std::string("unexpected: ") + e.what());
    }
    return ExitStatus::failed;
}

constexpr const char* k_out_of_memory = "out of memory; take a smaller model or picture";

// The JSON library's destructors allocate. Where there is no memory for that, the exception ends the program here.
[[noreturn]] void end_by_exception() {
    try {
        if (const std::exception_ptr thrown = std::current_exception())
            std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        print_error(k_out_of_memory);
        rimline::tools::remove_leftovers();
        std::_Exit(static_cast<int>(ExitStatus::failed));
    } catch (...) {
    }
    std::abort();
}

}  // namespace

int main(int argc, char** argv) {
    // A parent may have left it ignored; then it is not known how processes end.
    std::signal(SIGCHLD, SIG_DFL);
    rimline::tools::end_with_parent();
    rimline::tools::keep_freed_memory();
    std::set_terminate(end_by_exception);
    rimline::tools::open_missing_standard_descriptors();
    try {
        return static_cast<int>(run_and_report(argc, argv));
    } catch (const std::bad_alloc&) {
        print_error(k_out_of_memory);
        return static_cast<int>(ExitStatus::failed);
    }
}
