#pragma once

// The strict scanner of the text formats: lines of tokens, and tokens as numbers.
//
// A number is a whole token, otherwise it is an error. Locales are not used. NaN and infinity are
// rejected with an error that names them. Lines end with LF, CRLF or CR. Spaces and tabs separate
// tokens. Any other control character is part of a token, so it is an error in a number.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/point_source.h"

namespace rimline {

/// How a format's lines are read.
struct TextRules {
    char comment = '\0';         ///< Begins a comment up to the end of the line. 0 for none.
    bool continuations = false;  ///< A backslash at the end of a line continues the line.
};

class TextScanner {
public:
    /// `name` and `text` must outlive the scanner. `first_line` numbers the first line of `text`.
    TextScanner(std::string_view name, std::string_view text, TextRules rules = {},
                std::uint64_t first_line = 1)
        : name_(name), text_(text), rules_(rules), line_(first_line - 1) {}

    /// Moves to the next line that holds a token. Returns false at the end of the text.
    bool next_line();
    /// The same, but throws an error that `what` is missing at the end of the text.
    void expect_line(const char* what);

    /// The next token of the current line. Empty at its end.
    std::string_view token();
    /// The next token of this line or of a later line. Empty at the end of the text.
    std::string_view word();
    /// Throws an error if the current line holds another token. `what` names what should end the
    /// line.
    void expect_end_of_line(const char* what);
    /// The rest of the current line without spaces at its ends. Also '#' and a backslash at the end are part of
    /// it, because names of files and materials may hold them.
    std::string_view free_text();
    /// Skips the rest of the current line.
    void skip_line();
    /// The same for free text: a backslash at its end does not continue the line.
    void skip_free_text();

    /// The next token of the current line as a number. `what` names it in errors.
    float coordinate(const char* what) { return coordinate(token(), what); }
    std::int64_t integer(const char* what) { return integer(token(), what); }
    /// Any number in double, including NaN and infinities. Also reads the forms of Microsoft's C
    /// library before 2015: -1.#IND, 1.#QNAN. Returns infinity for a number that is too large.
    double number(const char* what) { return number(token(), what); }
    /// Skips a number that is not used. NaN and infinities are allowed, because exporters write
    /// them.
    void skip_number(const char* what) { skip_number(token(), what); }

    /// A given token of the current line as a number. A coordinate is within k_max_coordinate.
    /// BadPoints::keep also accepts NaN and infinity if the file spells them so.
    float coordinate(std::string_view token, const char* what,
                     BadPoints bad = BadPoints::refuse) const;
    std::int64_t integer(std::string_view token, const char* what) const;
    double number(std::string_view token, const char* what) const;
    void skip_number(std::string_view token, const char* what) const;

    std::string_view name() const noexcept { return name_; }
    std::uint64_t line() const noexcept { return line_; }
    /// Offset of the next byte to read. After next_line(), the offset of the line's first token.
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

/// Whether `token` is `lower`, a word in lower case, up to the case of ASCII letters.
bool equals_ignoring_case(std::string_view token, std::string_view lower) noexcept;

/// The number that the whole `token` spells, correctly rounded. Empty if it is not a number. Numbers
/// too small for a float give zero, too large ones infinity. "nan" and "inf" are accepted.
std::optional<float> parse_float(std::string_view token) noexcept;
/// The same for doubles.
std::optional<double> parse_double(std::string_view token) noexcept;
/// Empty if the whole `token` is not a decimal integer of 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view token) noexcept;

}  // namespace rimline
