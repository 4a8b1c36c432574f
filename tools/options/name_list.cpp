#include "tools/options/name_list.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <utility>

#include "tools/nearest_name.h"

namespace rimline::tools {

namespace {

std::string joined_names(std::span<const std::string_view> names) {
    std::string joined;
    for (const std::string_view name : names) joined.append(joined.empty() ? "" : ",").append(name);
    return joined;
}

std::vector<std::size_t> parse_names(const std::string& option,
                                     std::span<const std::string_view> names,
                                     std::string_view text) {
    std::vector<std::size_t> numbers;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const std::string_view name = rest.substr(0, comma);
        const auto found = std::ranges::find(names, name);
        if (found == names.end())
            throw CLI::ValidationError(
                option,
                "expected some of " + joined_names(names) + ", not '" + std::string(name) + "'" +
                    did_you_mean(name, std::vector<std::string>(names.begin(), names.end())));
        const auto number = static_cast<std::size_t>(found - names.begin());
        if (std::ranges::find(numbers, number) != numbers.end())
            throw CLI::ValidationError(option, "'" + std::string(name) + "' is given twice");
        numbers.push_back(number);
        if (comma == std::string_view::npos) return numbers;
        rest.remove_prefix(comma + 1);
    }
}

}  // namespace

CLI::Option* add_name_list(CLI::App& app, const std::string& option,
                           std::span<const std::string_view> names,
                           std::function<void(const std::vector<std::size_t>&)> set,
                           const std::string& description) {
    return app
        .add_option_function<std::string>(
            option,
            [option, names, set = std::move(set)](const std::string& text) {
                set(parse_names(option, names, text));
            },
            description + " " + joined_names(names))
        ->type_name("NAME,...");
}

}  // namespace rimline::tools
