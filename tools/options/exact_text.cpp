#include "tools/options/exact_text.h"

#include <array>
#include <charconv>
#include <string_view>

namespace rimline::tools {

namespace {

template <typename Number>
std::string shortest(Number value) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

}  // namespace

std::string exact_text(float value) {
    const std::string text = shortest(value);
    double parsed = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), parsed);
    // Both roundings together may differ from one.
    return float(parsed) == value ? text : exact_text(double{value});
}

std::string exact_text(double value) { return shortest(value); }

std::string quoted_for_shell(const std::string& text) {
    constexpr std::string_view k_plain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_@%+=:,./-";
    if (!text.empty() && text.find_first_not_of(k_plain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace rimline::tools
