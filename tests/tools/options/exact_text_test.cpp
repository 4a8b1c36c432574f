#include "tools/options/exact_text.h"

#include <doctest/doctest.h>

#include <charconv>

namespace rimline::tools {
namespace {

double parsed(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    REQUIRE(error == std::errc());
    REQUIRE(end == text.data() + text.size());
    return value;
}

TEST_CASE("a number parses to itself") {
    CHECK(exact_text(0.3f) == "0.3");
    CHECK(exact_text(35.0) == "35");
    for (float value = 1e-20f; value < 1e18f; value *= 1.0371f) {
        CHECK(float(parsed(exact_text(value))) == value);
        CHECK(float(parsed(exact_text(-value))) == -value);
        const double fine = double{value} / 3.0;
        CHECK(parsed(exact_text(fine)) == fine);
    }
}

TEST_CASE("a word for the shell is quoted where it must be") {
    CHECK(quoted_for_shell("a/b-1.obj") == "a/b-1.obj");
    CHECK(quoted_for_shell("a b") == "'a b'");
    CHECK(quoted_for_shell("#102030") == "'#102030'");
    CHECK(quoted_for_shell("it's") == "'it'\\''s'");
    CHECK(quoted_for_shell("") == "''");
    // Bytes that no terminal shows, as bash reads them.
    CHECK(quoted_for_shell("a\nb\x7f") == "$'a\\012b\\177'");
    CHECK(quoted_for_shell("\t'\\x") == "$'\\011\\'\\\\x'");
    CHECK(quoted_for_shell("\xc3\xa4") == "'\xc3\xa4'");
    CHECK(quoted_for_shell("a\xff"
                           "1.obj") == "$'a\\3771.obj'");    // No UTF-8.
    CHECK(quoted_for_shell("\xc2\x85") == "$'\\302\\205'");  // A control character of UTF-8.
}

}  // namespace
}  // namespace rimline::tools
