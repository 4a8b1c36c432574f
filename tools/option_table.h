#pragma once

// The subcommands and options of the program as plain data, for what is made of them beside --help: completion of
// shells and the manual page.

#include <string>
#include <string_view>
#include <vector>

#include "tools/cli_classes.h"

namespace rimline::tools {

struct OptionRow {
    std::vector<std::string> names;    ///< With their dashes; of an argument its name: "MODEL".
    std::string value;                 ///< The name of its value: "NUMBER"; empty for a flag.
    std::vector<std::string> choices;  ///< All values, where they are a list of names.
    std::vector<std::string> offered;  ///< By completion: these, or some of the values.
    std::string description;
    std::string group;
    bool is_argument = false;  ///< It has no dashes.

    bool takes_file() const { return is_argument || value.find("FILE") != std::string::npos; }
    bool takes_folder() const { return value.find("FOLDER") != std::string::npos; }
};

struct CommandRow {
    std::string path;  ///< "rimline", "rimline bench", "rimline bench hough".
    std::string name;  ///< Its last word.
    std::string summary, footer;
    std::vector<OptionRow> options;    ///< Without hidden ones. Arguments come first.
    std::vector<CommandRow> commands;  ///< Its subcommands, in the order of --help.
};

/// Of the name of a value (OptionRow::value) those that completion offers.
using OfferedValues = std::vector<std::string> (&)(std::string_view value);

/// The program with all that belongs to it. Call it before the command line is parsed.
CommandRow option_table(const CLI::App& app, OfferedValues offered_values);

/// `command` and all below it, each before its own.
std::vector<const CommandRow*> all_commands(const CommandRow& command);

}  // namespace rimline::tools
