#include "tools/output/same_picture.h"

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
}

TEST_CASE("the command repeats options that are given, but for the camera and the output") {
    CLI::App app;
    std::string model, output, eye, color, style;
    bool ground = false, hidden = false;
    app.add_option("MODEL", model);
    app.add_option("-o,--output", output);
    app.add_option("--eye", eye);
    app.add_option("--color", color);
    app.add_option("--style", style);
    app.add_flag("--ground", ground);
    app.add_flag("--hidden", hidden);
    app.parse("x.obj -o a.png --eye 1,2,3 --color #ff0000 --ground");
    CHECK(render_command(app, "'x y.obj'", {"--fov 35"}) ==
          "rimline render 'x y.obj' --color '#ff0000' --ground --fov 35");
}

}  // namespace
}  // namespace rimline::tools
