#include "silhouette/mesh/formats/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

namespace {

bool is_space(char c) noexcept { return c == ' ' || c == '\t'; }
bool is_newline(char c) noexcept { return c == '\n' || c == '\r'; }

// std::from_chars does not accept a leading plus.
std::string_view without_plus(std::string_view token) noexcept {
    if (token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+')
        token.remove_prefix(1);
    return token;
}

// Whether a decimal number out of range is too small, not too large. from_chars reports both as the
// same error. The position of the first nonzero digit and the exponent decide.
bool is_below_one(std::string_view number) noexcept {
    const std::size_t e = number.find_first_of("eE");
    const std::string_view mantissa = number.substr(0, e);
    std::int64_t exponent = 0;
    if (e != std::string_view::npos) {
        const std::string_view digits = without_plus(number.substr(e + 1));
        const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
        if (result.ec == std::errc::result_out_of_range) return digits.starts_with('-');
    }
    const std::size_t first = mantissa.find_first_of("123456789");
    if (first == std::string_view::npos) return true;
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const auto place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
    // Does not overflow: |place| is at most the token's length.
    return exponent < -place;
}

template <typename Real>
std::optional<Real> parse_real(std::string_view token) noexcept {
    const std::string_view number = without_plus(token);
    Real value = 0;
    const auto result = std::from_chars(number.data(), number.data() + number.size(), value);
    if (result.ptr != number.data() + number.size()) return std::nullopt;
    if (result.ec == std::errc::result_out_of_range) {
        const bool negative = number.starts_with('-');
        const Real magnitude =
            is_below_one(number) ? Real{0} : std::numeric_limits<Real>::infinity();
        return negative ? -magnitude : magnitude;
    }
    if (result.ec != std::errc{}) return std::nullopt;
    return value;
}

// How printf of Microsoft's C library wrote NaN and infinity until 2015. It shortened them to the
// requested precision or filled them with zeros.
bool is_old_microsoft_nan(std::string_view token) noexcept {
    if (token.starts_with('-') || token.starts_with('+')) token.remove_prefix(1);
    if (!token.starts_with("1.#")) return false;
    token.remove_prefix(3);
    token = token.substr(0, token.find_last_not_of('0') + 1);
    return token == "IND" || token == "QNAN" || token == "SNAN" || token == "INF";
}

}  // namespace

bool equals_ignoring_case(std::string_view token, std::string_view lower) noexcept {
    return std::ranges::equal(token, lower, [](char c, char l) {
        return (c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) == l;
    });
}

std::optional<float> parse_float(std::string_view token) noexcept {
    return parse_real<float>(token);
}

std::optional<double> parse_double(std::string_view token) noexcept {
    return parse_real<double>(token);
}

std::optional<std::int64_t> parse_integer(std::string_view token) noexcept {
    const std::string_view number = without_plus(token);
    std::int64_t value = 0;
    const auto result = std::from_chars(number.data(), number.data() + number.size(), value);
    if (result.ec != std::errc{} || result.ptr != number.data() + number.size())
        return std::nullopt;
    return value;
}

void TextScanner::step_over_newline() {
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    ++at_;
}

// Skips to the next token (returns false) or to the newline (returns true).
bool TextScanner::at_line_end() {
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (is_space(c)) {
            ++at_;
        } else if (is_newline(c)) {
            return true;
        } else if (rules_.comment != '\0' && c == rules_.comment) {
            while (at_ < text_.size() && !is_newline(text_[at_])) ++at_;
        } else if (rules_.continuations && c == '\\' &&
                   (at_ + 1 == text_.size() || is_newline(text_[at_ + 1]))) {
            ++at_;
            if (at_ == text_.size()) return true;
            step_over_newline();
            ++line_;
        } else {
            return false;
        }
    }
    return true;
}

void TextScanner::finish_line() {
    while (state_ == State::in_line) {
        if (!at_line_end()) {
            token();
            continue;
        }
        if (at_ < text_.size()) step_over_newline();
        state_ = State::between_lines;
    }
}

void TextScanner::skip_line() { finish_line(); }

std::string_view TextScanner::free_text() {
    if (state_ != State::in_line) return {};
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    const std::size_t begin = at_;
    std::size_t end = at_;
    for (; at_ < text_.size() && !is_newline(text_[at_]); ++at_)
        if (!is_space(text_[at_])) end = at_ + 1;
    return text_.substr(begin, end - begin);
}

void TextScanner::skip_free_text() {
    free_text();
    finish_line();
}

bool TextScanner::next_line() {
    for (;;) {
        finish_line();
        if (at_ == text_.size()) return false;
        ++line_;
        state_ = State::in_line;
        if (!at_line_end()) return true;
    }
}

void TextScanner::expect_line(const char* what) {
    if (!next_line()) fail(std::string("the file ends where ") + what + " should follow");
}

std::string_view TextScanner::token() {
    if (state_ != State::in_line || at_line_end()) return {};
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (is_space(c) || is_newline(c) || (rules_.comment != '\0' && c == rules_.comment)) break;
        if (rules_.continuations && c == '\\' &&
            (at_ + 1 == text_.size() || is_newline(text_[at_ + 1])))
            break;
        ++at_;
    }
    return text_.substr(begin, at_ - begin);
}

std::string_view TextScanner::word() {
    for (;;) {
        const std::string_view found = token();
        if (!found.empty() || !next_line()) return found;
    }
}

void TextScanner::expect_end_of_line(const char* what) {
    const std::string_view extra = token();
    if (!extra.empty()) fail(excerpt(extra) + " after " + what + ", which should end the line");
}

float TextScanner::coordinate(std::string_view token, const char* what, BadPoints bad) const {
    if (token.empty()) fail(std::string("the line ends where ") + what + " should follow");
    const std::optional<float> value = parse_float(token);
    if (!value) fail(excerpt(token) + " is not a number; " + what + " should stand here");
    if (!std::isfinite(*value) && token.find_first_of("nN") != std::string_view::npos) {
        if (bad == BadPoints::keep) return *value;
        fail(std::string(what) + " is " + excerpt(token) + "; only finite numbers can be used");
    }
    if (!(std::abs(*value) <= k_max_coordinate))
        fail(std::string(what) + " is " + excerpt(token) +
             ", beyond 2^60 in size; scale the model down");
    return *value;
}

std::int64_t TextScanner::integer(std::string_view token, const char* what) const {
    if (token.empty()) fail(std::string("the line ends where ") + what + " should follow");
    const std::optional<std::int64_t> value = parse_integer(token);
    if (!value) fail(excerpt(token) + " is not an integer; " + what + " should stand here");
    return *value;
}

double TextScanner::number(std::string_view token, const char* what) const {
    if (token.empty()) fail(std::string("the line ends where ") + what + " should follow");
    if (const std::optional<double> value = parse_double(token)) return *value;
    if (is_old_microsoft_nan(token)) return std::numeric_limits<double>::quiet_NaN();
    fail(excerpt(token) + " is not a number; " + what + " should stand here");
}

void TextScanner::skip_number(std::string_view token, const char* what) const {
    number(token, what);
}

}  // namespace rimline
