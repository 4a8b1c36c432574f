#include "tools/options/color.h"

#include <doctest/doctest.h>

namespace rimline::tools {
namespace {

TEST_CASE("a color is three, four, six or eight hexadecimal digits after #") {
    CHECK(color_of("#102030") == Color{0x10, 0x20, 0x30});
    CHECK(color_of("#AbCdEf") == Color{0xab, 0xcd, 0xef});
    CHECK(color_of("#1af") == Color{0x11, 0xaa, 0xff});
    CHECK(color_of("#1af8") == Color{0x11, 0xaa, 0xff, 0x88});
    CHECK(color_of("#10203040") == Color{0x10, 0x20, 0x30, 0x40});
    for (const char* text : {"", "#", "#1", "#12", "#12345", "#1234567", "#123456789", "#-12345",
                             "#12345g", "#+1+2+3", "102030", "# 12345", "#1 3", "0x102030"}) {
        CAPTURE(text);
        CHECK_FALSE(color_of(text));
    }
}

TEST_CASE("a color is a name of CSS in any case, or one of ours") {
    CHECK(color_of("red") == Color{255, 0, 0});
    CHECK(color_of("green") == Color{0, 128, 0});
    CHECK(color_of("aliceblue") == Color{240, 248, 255});
    CHECK(color_of("yellowgreen") == Color{154, 205, 50});
    CHECK(color_of("RebeccaPurple") == Color{102, 51, 153});
    CHECK(color_of("LightGoldenRodYellow") == Color{250, 250, 210});
    CHECK(color_of("darkslategrey") == color_of("darkslategray"));
    CHECK(color_of("paper") == Color{248, 244, 236});
    CHECK(color_of("sky") == Color{205, 222, 240});
    for (const char* text : {"reds", "re", " red", "none", "transparent", "currentcolor"}) {
        CAPTURE(text);
        CHECK_FALSE(color_of(text));
    }
}

TEST_CASE("a mistyped color name is answered with the nearest one") {
    CHECK(nearest_color("steelblu") == "; did you mean 'steelblue'?");
    CHECK(nearest_color("Rebecapurple") == "; did you mean 'rebeccapurple'?");
    CHECK(nearest_color("#12345") == "");
    CHECK(nearest_color("mxyzptlk") == "");
}

}  // namespace
}  // namespace rimline::tools
