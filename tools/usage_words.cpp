#include "tools/usage_words.h"

#include <CLI/App.hpp>
#include <algorithm>

#include "tools/nearest_name.h"

namespace rimline::tools {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

// The message for a command line without a suite, or with a suite that does not exist.
std::string missing_suite(const CLI::App& bench) {
    std::vector<std::string> names;
    std::string list;
    for (const CLI::App* suite : bench.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(suite->get_name());
        list += (list.empty() ? "" : ",") + suite->get_name();
    }
    const std::vector<std::string> rest = bench.remaining();
    return "SUITE: expected one of {" + list + "}" +
           (rest.empty() ? "" : ", not '" + rest.front() + "'" + did_you_mean(rest.front(), names));
}

// The message for arguments that no option and no position takes.
std::string unexpected(const CLI::App& app) {
    const std::vector<std::string> rest = app.remaining();
    const auto option = std::ranges::find_if(rest, [](const std::string& argument) {
        return argument.size() > 1 && argument.starts_with('-');
    });
    if (option == rest.end()) return "argument not expected: " + rest.front();
    const std::string name = option->substr(0, option->find('='));
    std::vector<std::string> names;
    for (const CLI::Option* known : app.get_options())
        for (const std::string& long_name : known->get_lnames()) names.push_back("--" + long_name);
    return "option not expected: " + name + did_you_mean(name, names);
}

}  // namespace

std::vector<const CLI::App*> parsed_chain(const CLI::App& app) {
    std::vector<const CLI::App*> chain{&app};
    while (!chain.back()->get_subcommands().empty())
        chain.push_back(chain.back()->get_subcommands().front());
    return chain;
}

std::string usage_words(const CLI::ParseError& error, const CLI::App& app) {
    const CLI::App& last = *parsed_chain(app).back();
    if (&last != &app && last.get_require_subcommand_min() > 0) return missing_suite(last);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !last.remaining().empty())
        return unexpected(last);

    // CLI11's messages are NAME: WHAT.
    const std::string message = error.what();
    const std::string name = message.substr(0, message.find(": "));
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        if (message.find("At Most 1 ") != std::string::npos) return name + ": give it only once";
        if (message.ends_with(" missing")) return name + ": expects a value after it";
    }
    // Of CLI::IsMember: NAME: VALUE not in {A,B,C}.
    const std::size_t choices = message.rfind(" not in {");
    if (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr &&
        choices != std::string::npos) {
        const std::size_t value_begin = name.size() + 2;
        const std::string value = message.substr(value_begin, choices - value_begin);
        const std::string list = message.substr(choices + 8);
        return name + ": expected one of " + list + ", not '" + value + "'" +
               did_you_mean(value, split(list.substr(1, list.size() - 2), ','));
    }
    return message;
}

std::string first_usage_words(const CLI::ParseError& error, const CLI::App& app) {
    const bool is_of_value = dynamic_cast<const CLI::ValidationError*>(&error) != nullptr ||
                             dynamic_cast<const CLI::ConversionError*>(&error) != nullptr ||
                             dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr;
    // CLI11 reads values in the order in which options were added. Those that are right may be read again.
    if (is_of_value)
        for (CLI::Option* option : parsed_chain(app).back()->parse_order()) try {
                option->run_callback();
            } catch (const CLI::ParseError& first) {
                return usage_words(first, app);
            }
    return usage_words(error, app);
}

}  // namespace rimline::tools
