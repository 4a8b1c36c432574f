#include "tools/options/exact_text.h"

#include <array>
#include <charconv>
#include <string_view>

#include "silhouette/printable_text.h"

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

std::string vector_text(const glm::vec3& v) {
    return exact_text(v.x) + "," + exact_text(v.y) + "," + exact_text(v.z);
}

std::string quoted_for_shell(const std::string& text) {
    constexpr std::string_view k_plain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_@%+=:,./-";
    if (!text.empty() && text.find_first_not_of(k_plain) == std::string::npos) return text;
    if (printable_text(text) != text) {
        // As bash, zsh and ksh read it.
        std::string quoted = "$'";
        for (const char c : text) {
            const auto byte = static_cast<unsigned char>(c);
            if (byte < 0x20 || byte >= 0x7f) {
                quoted.append("\\").append(1, char('0' + (byte >> 6)));
                quoted.append(1, char('0' + (byte >> 3 & 7))).append(1, char('0' + (byte & 7)));
            } else {
                if (c == '\'' || c == '\\') quoted += '\\';
                quoted += c;
            }
        }
        return quoted + "'";
    }
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace rimline::tools
