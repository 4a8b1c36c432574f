#include "tools/batch/batch_task.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "silhouette/printable_text.h"

namespace rimline::tools {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> k_output_options{"-o", "--output", "--save-scene",
                                                           "--export"};

constexpr std::array<std::string_view, 5> k_batch_places{"{stem}", "{name}", "{path}", "{ext}",
                                                         "{out}"};
using PlaceValues = std::array<std::string, k_batch_places.size()>;

void sort_unique(std::vector<std::string>& names) {
    std::ranges::sort(names);
    names.erase(std::ranges::unique(names).begin(), names.end());
}

// The text with each place in it filled, from left to right: what is filled in is not looked at again.
std::string filled(const std::string& text, const PlaceValues& values) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const auto found = std::ranges::find_if(k_batch_places, [&](std::string_view place) {
            return text.compare(at, place.size(), place) == 0;
        });
        if (found == k_batch_places.end()) {
            result += text[at++];
        } else {
            result += values[static_cast<std::size_t>(found - k_batch_places.begin())];
            at += found->size();
        }
    }
    return result;
}

// The file that a word names, after the word before it. Empty if none.
std::string output_in(const std::string& word, const std::string& before) {
    if (std::ranges::find(k_output_options, before) != k_output_options.end()) return word;
    for (const std::string_view option : k_output_options) {
        if (!word.starts_with(option) || word.size() == option.size()) continue;
        const bool has_sign = word[option.size()] == '=';
        if (option.starts_with("--")) {
            if (has_sign) return word.substr(option.size() + 1);
        } else if (!has_sign) {
            return word.substr(option.size());
        }
    }
    return {};
}

// Printable, and different for different texts.
std::string unambiguous_text(const std::string& text) {
    std::string escaped;
    for (const char c : text) escaped.append(c == '\\' ? 2 : 1, c);
    return printable_text(escaped);
}

}  // namespace

std::string unknown_batch_place(const std::string& text) {
    constexpr std::string_view k_word_letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
    for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1)) {
        const std::size_t end = text.find_first_not_of(k_word_letters, at + 1);
        if (end == std::string::npos || text[end] != '}' || end == at + 1) continue;
        const std::string place = text.substr(at, end + 1 - at);
        if (std::ranges::find(k_batch_places, place) == k_batch_places.end()) return place;
    }
    return {};
}

std::vector<std::string> batch_output_words(const std::vector<std::string>& subcommand) {
    std::vector<std::string> words;
    for (std::size_t i = 1; i < subcommand.size(); ++i)
        if (std::string word = output_in(subcommand[i], subcommand[i - 1]); !word.empty())
            words.push_back(std::move(word));
    return words;
}

std::string advice_for_two(const BatchInput& one, const BatchInput& other,
                           const std::string& word) {
    const auto has = [&](std::string_view place) { return word.find(place) != std::string::npos; };
    if (one.path() != other.path() && !has("{path}"))
        return has("{stem}") ? "use {path} in it in place of {stem}" : "use {path} in it";
    if (one.ext() != other.ext() && !has("{ext}") && !has("{name}"))
        return std::string("use {ext} in it too, as ") +
               (has("{stem}") && !has("{path}") ? "{stem}.{ext}" : "{path}.{ext}");
    return "name one folder above both, or do them in two batches";
}

BatchTask make_batch_task(const BatchInput& input, const std::vector<std::string>& subcommand,
                          const std::string& folder) {
    BatchTask task{.input = input,
                   .key = unambiguous_text(input.model),
                   .arguments = {subcommand.front(), input.model},
                   .command = {},
                   .outputs = {}};
    // A name is no option.
    if (input.model.starts_with('-')) task.arguments.back() = "./" + input.model;
    // By k_batch_places.
    const PlaceValues values{input.stem(), input.file(), input.path(), input.ext(), folder};
    for (std::size_t i = 1; i < subcommand.size(); ++i)
        task.arguments.push_back(filled(subcommand[i], values));
    for (const std::string& word : batch_output_words(subcommand))
        task.outputs.push_back(filled(word, values));
    for (const std::string& word : task.arguments)
        task.command += (task.command.empty() ? "" : " ") + unambiguous_text(word);
    return task;
}

std::vector<std::string> BatchTask::found_outputs() const {
    std::vector<std::string> files;
    for (const std::string& output : outputs) {
        std::error_code error;
        if (!fs::exists(output, error)) continue;
        if (!fs::is_directory(output, error)) {
            files.push_back(output);
            continue;
        }
        for (const fs::directory_entry& entry : fs::directory_iterator(output, error))
            if (entry.is_regular_file(error)) files.push_back(entry.path().string());
    }
    sort_unique(files);
    return files;
}

std::vector<std::string> BatchTask::named_outputs() const {
    std::vector<std::string> names = found_outputs();
    for (std::string& name : names) name = printable_text(name);
    sort_unique(names);
    return names;
}

}  // namespace rimline::tools
