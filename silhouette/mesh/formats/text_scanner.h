#pragma once

// The strict scanner of the text formats: lines of tokens, and tokens as numbers.
//
// A number is a whole token or an error: no prefix of one is taken, no locale is asked, NaN and
// infinity are named and refused. Lines end with LF, CRLF or CR; tokens are separated by spaces and
// tabs; any other control character is part of a token, and so an error where a number belongs.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/point_source.h"

namespace rimline {

/// How a format's lines are read.
struct TextRules {
    char comment = '\0';         ///< What follows it on a line is skipped; none when 0.
    bool continuations = false;  ///< A backslash at a line's end joins the next line to it.
};

class TextScanner {
public:
    /// `name` and `text` must outlive the scanner. `first_line` numbers the first line of `text`.
    TextScanner(std::string_view name, std::string_view text, TextRules rules = {},
                std::uint64_t first_line = 1)
        : name_(name), text_(text), rules_(rules), line_(first_line - 1) {}

    /// Moves to the next line that holds a token; false at the end of the text.
    bool next_line();
    /// The same, or an error that says `what` is missing.
    void expect_line(const char* what);

    /// The next token of the current line, empty at its end.
    std::string_view token();
    /// The next token of this line or of later ones, empty at the end of the text.
    std::string_view word();
    /// Fails when the current line holds another token. `what` names what it should have held.
    void expect_end_of_line(const char* what);
    /// Ends the current line, whatever it still holds.
    void skip_line();
    /// The same, where what it holds is free text: a backslash at its end joins nothing to it.
    void skip_free_text();

    /// The next token of the current line as a number. `what` names it in errors.
    float coordinate(const char* what) { return coordinate(token(), what); }
    std::int64_t integer(const char* what) { return integer(token(), what); }
    /// Any number, in double: NaN and infinities too, also in the way of Microsoft's C library before
    /// 2015: -1.#IND, 1.#QNAN. Too large for a double is an infinity.
    double number(const char* what) { return number(token(), what); }
    /// A number that is not used: NaN and infinities are let pass, as exporters write them.
    void skip_number(const char* what) { skip_number(token(), what); }

    /// A given token of the current line as a number. A coordinate is within k_max_coordinate, or is
    /// kept where the file calls it NaN or infinite.
    float coordinate(std::string_view token, const char* what,
                     BadPoints bad = BadPoints::refuse) const;
    std::int64_t integer(std::string_view token, const char* what) const;
    double number(std::string_view token, const char* what) const;
    void skip_number(std::string_view token, const char* what) const;

    std::uint64_t line() const noexcept { return line_; }
    /// Bytes that lie before what is read next. After next_line(): where the line's tokens begin.
    std::size_t offset() const noexcept { return at_; }
    std::size_t remaining() const noexcept { return text_.size() - at_; }
    double share() const noexcept {
        return text_.empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(text_.size());
    }

    [[noreturn]] void fail(const std::string& what) const { bad_line(name_, line_, what); }

private:
    enum class State { between_lines, in_line };
    void finish_line();
    bool at_line_end();
    void step_over_newline();

    std::string_view name_;
    std::string_view text_;
    TextRules rules_;
    std::size_t at_ = 0;
    std::uint64_t line_;
    State state_ = State::between_lines;
};

/// The number that all of `token` spells, correctly rounded; nothing where it spells none. Too small
/// for a float is zero, too large an infinity; "nan" and "inf" give what they say.
std::optional<float> parse_float(std::string_view token) noexcept;
/// The same for doubles.
std::optional<double> parse_double(std::string_view token) noexcept;
/// Nothing where `token` is not a whole decimal integer of 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view token) noexcept;

}  // namespace rimline
