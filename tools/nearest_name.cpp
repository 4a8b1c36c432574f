#include "tools/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace rimline::tools {

namespace {

char lower_case(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Rows of the table of distances between beginnings of `a` and of `b`: the one before last, the last, this one.
    std::vector<std::size_t> earlier(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        earlier.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const char c = lower_case(a[i - 1]), d = lower_case(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (c == d ? 0u : 1u)});
            if (i > 1 && j > 1 && c == lower_case(b[j - 2]) && lower_case(a[i - 2]) == d)
                row[j] = std::min(row[j], earlier[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string nearest_name(std::string_view text, std::span<const std::string> names) {
    std::size_t least = std::clamp<std::size_t>(text.size() / 3, 1, 3) + 1;
    std::string nearest;
    for (const std::string& name : names) {
        const std::size_t distance = edit_distance(text, name);
        if (name == text) return {};
        // A name of which every letter differs is not a mistyped one.
        if (distance >= least || distance >= name.size()) continue;
        least = distance;
        nearest = name;
    }
    return nearest;
}

std::string did_you_mean(std::string_view text, std::span<const std::string> names) {
    const std::string name = nearest_name(text, names);
    return name.empty() ? "" : "; did you mean '" + name + "'?";
}

}  // namespace rimline::tools
