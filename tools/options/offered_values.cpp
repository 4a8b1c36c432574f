#include "tools/options/offered_values.h"

#include <algorithm>
#include <array>

#include "tools/options/color.h"
#include "tools/options/up_option.h"
#include "tools/options/view_option.h"

namespace rimline::tools {

namespace {

struct ValueWord {
    std::string_view word;
    std::vector<std::string> (*names)();
};

constexpr std::array<ValueWord, 4> k_words{{{"VIEW", view_names},
                                            {"AXIS", axis_names},
                                            {"COLOR", color_names},
                                            {"PALETTE", offered_palettes}}};

bool is_value(std::string_view word) {
    return !word.empty() && std::ranges::all_of(word, [](char c) { return c >= 'a' && c <= 'z'; });
}

}  // namespace

std::vector<std::string> offered_values(std::string_view value) {
    std::vector<std::string> offered;
    while (!value.empty()) {
        const std::size_t bar = std::min(value.find('|'), value.size());
        const std::string_view word = value.substr(0, bar);
        value.remove_prefix(std::min(bar + 1, value.size()));
        if (is_value(word)) offered.emplace_back(word);
        const auto* named = std::ranges::find(k_words, word, &ValueWord::word);
        if (named == k_words.end()) continue;
        const std::vector<std::string> names = named->names();
        offered.insert(offered.end(), names.begin(), names.end());
    }
    return offered;
}

}  // namespace rimline::tools
