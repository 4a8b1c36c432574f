#include "tools/shell_completion.h"

#include <string_view>

namespace rimline::tools {

namespace {

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
    std::string text;
    for (const std::string& word : words) text.append(text.empty() ? "" : separator).append(word);
    return text;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

std::vector<std::string> option_names(const CommandRow& command) {
    std::vector<std::string> names;
    for (const OptionRow& option : command.options)
        if (!option.is_argument)
            names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

std::vector<std::string> command_names(const CommandRow& command) {
    std::vector<std::string> names;
    for (const CommandRow& below : command.commands) names.push_back(below.name);
    return names;
}

// In single quotes for zsh's _arguments, which gives meaning to brackets and colons.
std::string zsh_text(std::string text) {
    text = replaced(replaced(std::move(text), "\\", "\\\\"), "'", "'\\''");
    for (const std::string_view special : {"[", "]", ":"})
        text = replaced(std::move(text), special, "\\" + std::string(special));
    return text;
}

std::string zsh_action(const OptionRow& option) {
    if (!option.offered.empty()) return "(" + joined(option.offered, " ") + ")";
    if (option.takes_file()) return "_files";
    return option.takes_folder() ? "_files -/" : " ";
}

std::string zsh_arguments(const CommandRow& command) {
    std::string text = "_arguments -s";
    for (const OptionRow& option : command.options) {
        const std::string description = "[" + zsh_text(option.description) + "]";
        const std::string value =
            option.value.empty() ? "" : ":" + zsh_text(option.value) + ":" + zsh_action(option);
        for (const std::string& name : option.names) {
            text += " \\\n        ";
            if (option.is_argument)
                text += "'*:" + zsh_text(name) + ":_files'";
            else
                text += "'*" + name + description + value + "'";
        }
    }
    return text;
}

std::string zsh_list(const std::vector<CommandRow>& commands) {
    std::string list;
    for (const CommandRow& command : commands)
        list += "        '" + command.name + ":" + zsh_text(command.summary) + "'\n";
    return list;
}

std::string fish_text(std::string text) {
    text = replaced(replaced(std::move(text), "\\", "\\\\"), "'", "\\'");
    return "'" + text + "'";
}

}  // namespace

std::string bash_completion(const CommandRow& program) {
    std::string paths, values, words;
    for (const CommandRow* command : all_commands(program)) {
        if (command != &program)
            paths += (paths.empty() ? "" : "|") + ("\"" + command->path) + "\"";
        words += "        \"" + command->path + "\") commands=\"" +
                 joined(command_names(*command), " ") + "\" options=\"" +
                 joined(option_names(*command), " ") + "\" ;;\n";
        for (const OptionRow& option : command->options) {
            if (option.is_argument || option.value.empty()) continue;
            std::vector<std::string> places;
            for (const std::string& name : option.names)
                places.push_back("\"" + command->path + " " + name + "\"");
            std::string action = ":";
            if (!option.offered.empty())
                action =
                    "COMPREPLY=($(compgen -W \"" + joined(option.offered, " ") + "\" -- \"$cur\"))";
            else if (option.takes_file())
                action = "COMPREPLY=($(compgen -f -- \"$cur\"))";
            else if (option.takes_folder())
                action = "COMPREPLY=($(compgen -d -- \"$cur\"))";
            values += "        " + joined(places, "|") + ") " + action + "; return ;;\n";
        }
    }
    return "# Completion of " + program.name + R"(, made from its table of options.

_)" + program.name +
           R"(() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} path=)" +
           program.name + R"( word commands= options=
    COMPREPLY=()
    # --option=value are three words.
    if [[ $cur == = ]]; then
        cur=
    elif [[ $prev == = ]]; then
        prev=${COMP_WORDS[COMP_CWORD-2]}
    fi
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        case "$path $word" in
        )" +
           paths +
           R"() path="$path $word" ;;
        )" +
           program.name + R"(\ batch\ --) path=)" + program.name + R"( ;;
        esac
    done
    case "$path $prev" in
)" + values +
           R"(    esac
    case "$path" in
)" + words +
           R"(    esac
    if [[ $cur == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$cur"))
    elif [[ $commands ]]; then
        COMPREPLY=($(compgen -W "$commands" -- "$cur"))
    else
        COMPREPLY=($(compgen -f -- "$cur"))
    fi
}
complete -o filenames -F _)" +
           program.name + " " + program.name + "\n";
}

std::string zsh_completion(const CommandRow& program) {
    std::string cases;
    for (const CommandRow& command : program.commands) {
        cases += "    " + command.name + ")\n";
        if (command.name == "batch")
            // What follows -- is a command line of its own.
            cases +=
                "        local -i end=${words[(i)--]}\n        if (( end < CURRENT )); then\n"
                "        shift $(( end - 1 )) words; (( CURRENT -= end - 1 )); _" +
                program.name + "; return\n        fi\n";
        if (command.commands.empty()) {
            cases += "        " + zsh_arguments(command) + "\n        ;;\n";
            continue;
        }
        cases += "        if (( CURRENT == 2 )); then\n        commands=(\n" +
                 zsh_list(command.commands) + "        )\n        _describe suite commands\n" +
                 "        else\n        shift words; (( CURRENT-- ))\n        case $words[1] in\n";
        for (const CommandRow& below : command.commands)
            cases +=
                "        " + below.name + ")\n        " + zsh_arguments(below) + "\n        ;;\n";
        cases += "        esac\n        fi\n        ;;\n";
    }
    return "#compdef " + program.name + "\n# Made from the table of options of " + program.name +
           ".\n\n_" + program.name +
           "() {\n    local -a commands\n    if (( CURRENT == 2 )); then\n" + "    commands=(\n" +
           zsh_list(program.commands) + "    )\n" + "    _describe subcommand commands\n    " +
           zsh_arguments(program) +
           "\n    return\n    fi\n    shift words; (( CURRENT-- ))\n    case $words[1] in\n" +
           cases + "    esac\n}\n\n_" + program.name + " \"$@\"\n";
}

std::string fish_completion(const CommandRow& program) {
    const std::string at = "__" + program.name + "_at", batched = "__" + program.name + "_batched";
    std::string paths, lines;
    for (const CommandRow* command : all_commands(program)) {
        if (command != &program) paths += " '" + command->path + "'";
        const std::string line =
            "complete -c " + program.name + " -n \"" + at + " '" + command->path + "'\"";
        for (const CommandRow& below : command->commands)
            lines += line + " -f -a " + below.name + " -d " + fish_text(below.summary) + "\n";
        for (const OptionRow& option : command->options) {
            if (option.is_argument) continue;
            lines += line;
            for (const std::string& name : option.names)
                lines += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.offered.empty())
                lines += " -x -a '" + joined(option.offered, " ") + "'";
            else if (option.takes_file())
                lines += " -r -F";
            else if (option.takes_folder())
                lines += " -x -a '(__fish_complete_directories)'";
            else if (!option.value.empty())
                lines += " -x";
            lines += " -d " + fish_text(option.description) + "\n";
        }
    }
    return "# Completion of " + program.name + ", made from its table of options.\n\n" +
           "function " + at + "\n    set -l path " + program.name +
           "\n    for word in (commandline -opc)[2..-1]\n"
           "        if contains -- \"$path $word\"" +
           paths +
           "\n            set path \"$path $word\"\n        end\n    end\n"
           "    test \"$path\" = \"$argv[1]\"\nend\n\n" +
           "# What follows batch -- is a command line of its own.\n" + "function " + batched +
           "\n    set -l words (commandline -opc)\n"
           "    set -l end (contains -i -- -- $words)\n"
           "    and test \"$words[2]\" = batch\n"
           "    and string join ' ' -- " +
           program.name + " $words[(math $end + 1)..-1] (commandline -ct)\nend\n" + "complete -c " +
           program.name + " -n '" + batched + " >/dev/null' -x -a '(complete -C (" + batched +
           "))'\n" + lines;
}

}  // namespace rimline::tools
