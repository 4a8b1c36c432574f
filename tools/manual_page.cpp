#include "tools/manual_page.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace rimline::tools {

namespace {

// Text of roff: a backslash begins a command, and so do a point and a quote at the beginning of a line.
std::string roff_text(std::string_view text) {
    std::string result;
    bool is_line_start = true;
    for (const char c : text) {
        if (is_line_start && (c == '.' || c == '\'')) result += "\\&";
        is_line_start = c == '\n';
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    return result;
}

std::string bold(std::string_view text) { return "\\fB" + roff_text(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff_text(text) + "\\fR"; }

std::string upper_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    });
    return text;
}

std::string option_text(const OptionRow& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += (names.empty() ? "" : ", ") + (option.is_argument ? italic(name) : bold(name));
    if (!option.is_argument && !option.value.empty()) names += " " + italic(option.value);
    std::string text = ".TP\n" + names + "\n" + roff_text(option.description);
    std::string choices;
    for (const std::string& choice : option.choices)
        choices += (choices.empty() ? "" : ", ") + bold(choice);
    if (!choices.empty()) text += ": " + choices;
    return text + ".\n";
}

std::string command_text(const CommandRow& command) {
    std::string text = ".SS " + roff_text(command.path) + "\n" + roff_text(command.summary) + ".\n";
    for (const OptionRow& option : command.options) text += option_text(option);
    if (!command.footer.empty()) text += ".PP\n.nf\n" + roff_text(command.footer) + "\n.fi\n";
    return text;
}

}  // namespace

std::string manual_page(const CommandRow& program, const std::string& version) {
    std::string page = ".TH " + upper_case(program.name) + " 1 \"\" \"" + program.name + " " +
                       version + "\" \"User Commands\"\n" + ".SH NAME\n" + roff_text(program.name) +
                       " \\- finds and draws the silhouettes of 3D models\n" + ".SH SYNOPSIS\n" +
                       bold(program.name) + " " + italic("SUBCOMMAND") + " [" + italic("MODEL") +
                       "] [" + italic("options") + "]\n.SH DESCRIPTION\n" +
                       roff_text(program.summary) + "\n.PP\n.nf\n" + roff_text(program.footer) +
                       "\n.fi\n.SH OPTIONS\n";
    for (const OptionRow& option : program.options) page += option_text(option);
    page += ".SH SUBCOMMANDS\n";
    for (const CommandRow* command : all_commands(program))
        if (command != &program) page += command_text(*command);
    page += ".SH EXIT STATUS\n";
    for (const auto& [status, meaning] :
         {std::pair("0", "Success."), std::pair("1", "An input or the machine is at fault."),
          std::pair("2", "Wrong usage."), std::pair("3", "A check failed.")})
        page += ".TP\n" + bold(status) + "\n" + meaning + "\n";
    page += ".SH ENVIRONMENT\n.TP\n" + bold("RIMLINE_DEVICE") +
            "\nThe Vulkan device to use where there is no " + bold("--device") + ".\n.TP\n" +
            bold("RIMLINE_MODELS") +
            "\nFolders, separated by colons, where benchmarks look for models.\n";
    return page;
}

}  // namespace rimline::tools
