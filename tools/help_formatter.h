#pragma once

// The layout of --help: descriptions are wrapped beside their options, with one empty line between groups.

#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>
#include <string>

namespace rimline::tools {

class HelpFormatter final : public CLI::Formatter {
public:
    HelpFormatter() {
        column_width(k_option_columns);
        label("SUBCOMMANDS", "subcommands");
    }

    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override {
        std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
        for (std::size_t at; (at = help.find("\n\n\n")) != std::string::npos;) help.erase(at, 1);
        return help;
    }

    std::string make_option_desc(const CLI::Option* option) const override {
        std::string text = CLI::Formatter::make_option_desc(option);
        std::size_t line_start = 0;
        while (text.size() - line_start > k_description_columns) {
            const std::size_t space = text.rfind(' ', line_start + k_description_columns);
            if (space == std::string::npos || space <= line_start) break;
            text[space] = '\n';  // The base class indents the next line.
            line_start = space + 1;
        }
        return text;
    }

private:
    static constexpr std::size_t k_option_columns = 28;
    static constexpr std::size_t k_description_columns = 70;
};

}  // namespace rimline::tools
