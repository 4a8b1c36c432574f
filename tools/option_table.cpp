#include "tools/option_table.h"

#include <CLI/App.hpp>
#include <algorithm>

namespace rimline::tools {

namespace {

std::vector<std::string> split_choices(std::string_view list) {
    std::vector<std::string> choices;
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        choices.emplace_back(list.substr(0, comma));
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return choices;
}

// CLI11's name of a type ends with what CLI::IsMember takes: TEXT:{ink,toon}.
void set_value(OptionRow& row, const CLI::Option& option, OfferedValues offered_values) {
    if (option.get_items_expected_max() == 0) return;
    row.value = option.get_type_name();
    const std::size_t brace = row.value.find('{');
    if (brace != std::string::npos && row.value.ends_with('}')) {
        row.choices = split_choices(
            std::string_view(row.value).substr(brace + 1, row.value.size() - brace - 2));
        row.value.resize(brace);
        if (row.value.ends_with(':')) row.value.pop_back();
    }
    row.offered = row.choices.empty() ? offered_values(row.value) : row.choices;
    if (row.value == "TEXT" || row.value.empty()) row.value = "NAME";
}

OptionRow row_of(const CLI::Option& option, OfferedValues offered_values) {
    OptionRow row;
    for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
    row.is_argument = row.names.empty();
    if (row.is_argument) row.names.push_back(option.get_name(true));
    set_value(row, option, offered_values);
    row.description = option.get_description();
    row.group = option.get_group();
    return row;
}

CommandRow command_row(const CLI::App& app, const std::string& before,
                       OfferedValues offered_values) {
    CommandRow row{.path = before.empty() ? app.get_name() : before + " " + app.get_name(),
                   .name = app.get_name(),
                   .summary = app.get_description(),
                   .footer = app.get_footer(),
                   .options = {},
                   .commands = {}};
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty()) row.options.push_back(row_of(*option, offered_values));
    std::ranges::stable_partition(row.options, &OptionRow::is_argument);
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        row.commands.push_back(command_row(*command, row.path, offered_values));
    return row;
}

void append(std::vector<const CommandRow*>& all, const CommandRow& command) {
    all.push_back(&command);
    for (const CommandRow& below : command.commands) append(all, below);
}

}  // namespace

CommandRow option_table(const CLI::App& app, OfferedValues offered_values) {
    return command_row(app, {}, offered_values);
}

std::vector<const CommandRow*> all_commands(const CommandRow& command) {
    std::vector<const CommandRow*> all;
    append(all, command);
    return all;
}

}  // namespace rimline::tools
