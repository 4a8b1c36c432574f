#include "silhouette/printable_text.h"

#include <doctest/doctest.h>

#include <string>

using rimline::printable_text;

TEST_CASE("text that can be printed stays as it is") {
    // Of two, three and four bytes, and the last before and the first after the surrogates.
    for (const char* text : {"", "a b/c-1.obj", "\\x41", "h\xc3\xa4user.obj", "\xe2\x82\xac",
                             "\xf0\x9f\x90\xb0", "\xed\x9f\xbf", "\xee\x80\x80", "\xc2\xa0"})
        CHECK(printable_text(text) == text);
}

TEST_CASE("control characters are shown as their bytes") {
    CHECK(printable_text("a\nb") == "a\\x0ab");
    CHECK(printable_text(std::string("\0\x1b[2J\x7f", 6)) == "\\x00\\x1b[2J\\x7f");
    CHECK(printable_text("\xc2\x9b") == "\\xc2\\x9b");
    CHECK(printable_text("\xef\xbf\xbf") == "\\xef\\xbf\\xbf");
}

TEST_CASE("bytes that are no character in UTF-8 are shown one by one") {
    CHECK(printable_text("h\xe4user") == "h\\xe4user");
    CHECK(printable_text("\x80") == "\\x80");
    CHECK(printable_text("\xc3") == "\\xc3");                    // Its second byte is missing.
    CHECK(printable_text("\xe2\x82") == "\\xe2\\x82");           // Its third is.
    CHECK(printable_text("\xe2\x82x") == "\\xe2\\x82x");         // Its third is another.
    CHECK(printable_text("\xc0\xaf") == "\\xc0\\xaf");           // '/' in two bytes.
    CHECK(printable_text("\xe0\x80\xaf") == "\\xe0\\x80\\xaf");  // In three.
    CHECK(printable_text("\xed\xa0\x80") == "\\xed\\xa0\\x80");  // A surrogate.
    CHECK(printable_text("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // Beyond Unicode.
    CHECK(printable_text("\xff\xc3\xa4") == "\\xff\xc3\xa4");
}
