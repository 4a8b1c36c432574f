#include "tools/usage_words.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <span>
#include <string_view>

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

// Not of values that begin with a dash: -1,2,3 and -.5.
bool is_option(const std::string& argument) {
    return argument.size() > 1 && argument.starts_with('-') &&
           std::string_view("0123456789.").find(argument[1]) == std::string_view::npos;
}

// "; did you mean '--output'?" for --out: the only one that begins so, or else the nearest.
std::string did_you_mean_option(const std::string& name, std::span<const std::string> names) {
    const auto goes_on = [&](const std::string& known) { return known.starts_with(name); };
    if (name.starts_with("--") && std::ranges::count_if(names, goes_on) == 1)
        return "; did you mean '" + *std::ranges::find_if(names, goes_on) + "'?";
    return did_you_mean(name, names);
}

// The message for the first option that there is not. Empty if there is none.
std::string unknown_option(const CLI::App& app) {
    const std::vector<std::string> rest = app.remaining();
    const auto option = std::ranges::find_if(rest, is_option);
    if (option == rest.end()) return "";
    const std::string name = option->substr(0, option->find('='));
    std::vector<std::string> names;
    for (const CLI::Option* known : app.get_options())
        for (const std::string& long_name : known->get_lnames()) names.push_back("--" + long_name);
    return "option not expected: " + name + did_you_mean_option(name, names);
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
    const bool has_extras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    // CLI11 misses the option that was meant before it looks at the one that was typed.
    if (has_extras || dynamic_cast<const CLI::RequiredError*>(&error) != nullptr ||
        dynamic_cast<const CLI::RequiresError*>(&error) != nullptr)
        if (const std::string words = unknown_option(last); !words.empty()) return words;
    if (has_extras && !last.remaining().empty())
        return "argument not expected: " + last.remaining().front();

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
