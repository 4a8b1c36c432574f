#include "silhouette/printable_text.h"

#include <cstddef>
#include <cstdint>

#include "silhouette/error.h"

namespace rimline {

namespace {

// The bytes of the character that `text` begins with; 0 if it begins with none. Refuses overlong forms, surrogates
// and what lies beyond Unicode (RFC 3629).
std::size_t character_length(std::string_view text, char32_t& code) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
    };
    const std::uint8_t first = byte(0);
    if (first < 0x80) {
        code = first;
        return 1;
    }
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    code = first & (0xffu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3f);
    }
    constexpr char32_t k_least[] = {0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    if (first < 0xc0 || first > 0xf4 || code < k_least[length - 2] || code > 0x10ffff ||
        is_surrogate)
        return 0;
    return length;
}

// U+FFFE and U+FFFF are no characters either, and forbidden in XML.
bool is_control(char32_t code) {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code & 0xfffe) == 0xfffe;
}

}  // namespace

std::string printable_text(std::string_view text) {
    constexpr std::string_view k_digits = "0123456789abcdef";
    std::string printable;
    while (!text.empty()) {
        char32_t code = 0;
        const std::size_t length = character_length(text, code);
        const std::string_view bytes = text.substr(0, length == 0 ? 1 : length);
        text.remove_prefix(bytes.size());
        if (length > 0 && !is_control(code)) {
            printable += bytes;
            continue;
        }
        for (const char c : bytes) {
            const auto byte = static_cast<std::uint8_t>(c);
            printable.append("\\x").append(1, k_digits[byte >> 4]).append(1, k_digits[byte & 15]);
        }
    }
    return printable;
}

std::u16string utf16_of(std::string_view text) {
    std::u16string units;
    while (!text.empty()) {
        char32_t code = 0;
        const std::size_t length = character_length(text, code);
        RIMLINE_CHECK(length > 0);
        text.remove_prefix(length);
        if (code < 0x10000) {
            units += static_cast<char16_t>(code);
        } else {
            units += static_cast<char16_t>(0xd800 + ((code - 0x10000) >> 10));
            units += static_cast<char16_t>(0xdc00 + ((code - 0x10000) & 0x3ff));
        }
    }
    return units;
}

}  // namespace rimline
