#include "tools/options/option_types.h"

#include <doctest/doctest.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/tools/scratch_folder.h"
#include "tools/options/model_argument.h"

using namespace rimline::tools;

namespace {

// Parses as a program would; false where CLI11 reports wrong usage.
bool parses(CLI::App& app, std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());
    try {
        app.parse(arguments);
    } catch (const CLI::ParseError&) {
        return false;
    }
    return true;
}

}  // namespace

TEST_CASE("a point is exactly three finite numbers in range") {
    CHECK(parse_point("--from", "1,2,3") == glm::vec3(1, 2, 3));
    CHECK(parse_point("--from", "-1.5,0,2e3") == glm::vec3(-1.5f, 0, 2000));
    CHECK(parse_point("--from", "1e-300,-0,1152921504606846976") == glm::vec3(0, 0, 0x1p60f));
    for (const char* text : {"1, 2, 3", " 1,2,3 ", "1 ,\t2 , 3", "+1,2,+3", "+1, +2, +3e0"}) {
        CAPTURE(text);
        CHECK(parse_point("--from", text) == glm::vec3(1, 2, 3));
    }
    for (const char* text :
         {"",         "1",         "1,2",      "1,2,",  ",1,2",   "1,,2",    "1,2,3,",  "1,2,3,4",
          "1, ,3",    "+-1,2,3",   "++1,2,3",  "1,2,x", "1,2,3x", "0x1,2,3", "nan,0,0", "inf,0,0",
          "1,-inf,0", "1e400,0,0", "1e19,0,0", "1;2;3", "1 2 3",  "[1,2,3]", "--1,2,3"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_point("--from", text), CLI::ValidationError);
    }
}

TEST_CASE("a direction is a point that is not zero once small components are dropped") {
    CHECK(parse_direction("--sun", "0,0,-1") == glm::vec3(0, 0, -1));
    CHECK(parse_direction("--sun", "1e-18,0,0").x > 0.0f);
    CHECK_THROWS_AS(parse_direction("--sun", "0,0,0"), CLI::ValidationError);
    CHECK_THROWS_AS(parse_direction("--sun", "0,-0,0"), CLI::ValidationError);
    CHECK_THROWS_AS(parse_direction("--sun", "1e-19,0,1e-30"), CLI::ValidationError);
}

TEST_CASE("a value that begins with a minus is the option's, not another option") {
    CLI::App app;
    std::optional<glm::vec3> from;
    add_point(app, "--from", from, "");
    REQUIRE(parses(app, {"--from", "-1,-2,-3"}));
    CHECK(from == glm::vec3(-1, -2, -3));
    REQUIRE(parses(app, {"--from=-4,5,6"}));
    CHECK(from == glm::vec3(-4, 5, 6));
    CHECK_FALSE(parses(app, {"--from", "1,2,3", "--from", "4,5,6"}));
}

TEST_CASE("an output's name has its ending, but for what is no regular file") {
    const rimline::tests::ScratchFolder folder;
    rimline::tests::write_bytes(folder / "old.txt", "old");
    const auto takes = [](const std::string& text) {
        CLI::App app;
        std::string value = "default.png";
        add_output(app, "-o,--output", value, ".png", "");
        const bool is_taken = parses(app, {"-o", text});
        CHECK(value == (is_taken ? text : "default.png"));
        return is_taken;
    };
    for (const char* text : {"a.png", "A.PNG", "a.obj.png", "no/such/a.png", "/dev/null"}) {
        CAPTURE(text);
        CHECK(takes(text));
    }
    for (const char* text : {"", "a", "png", "apng", "a.obj", "a.png.obj", "a.png ", "no/such"}) {
        CAPTURE(text);
        CHECK_FALSE(takes(text));
    }
    CHECK_FALSE(takes(folder / "old.txt"));
    CHECK(takes(folder / ""));  // Refused as a folder, when it is opened.
}

TEST_CASE("a repeatable option takes one value at a time and leaves the model alone") {
    CLI::App app;
    ModelArgument model;
    std::vector<glm::vec3> suns;
    model.add_to(app);
    add_directions(app, "--sun", suns, "");
    REQUIRE(parses(app, {"--sun", "1,0,0", "a.obj", "--sun", "0,-1,0"}));
    CHECK(model.model == "a.obj");
    CHECK(suns == std::vector{glm::vec3(1, 0, 0), glm::vec3(0, -1, 0)});
    CHECK_FALSE(parses(app, {"a.obj", "--sun", "1,0,0", "--sun", "0,0,0"}));
}

TEST_CASE("a model is a file, or a built-in shape with a sensible number of faces") {
    for (const char* name : {"a.obj", "no/such/file", "shapes", "shape:box", "shape:knot:70000"}) {
        CAPTURE(name);
        CHECK_NOTHROW(check_model_name(name));
    }
    for (const char* name :
         {"", "shape:", "shape:cube", "shape:box:", "shape:box:0", "shape:box:-1", "shape:box:1.5",
          "shape:box:12x", "shape:box:268435457", "shape:box:99999999999", "shape:box:1:2"}) {
        CAPTURE(name);
        CHECK_THROWS_AS(check_model_name(name), CLI::ValidationError);
    }
}

TEST_CASE("numbers and counts keep to their range and their default") {
    CLI::App app;
    double fov = 35.0;
    std::uint32_t seed = 7;
    add_number(app, "--fov", fov, 1.0, 170.0, "");
    add_count(app, "--seed", seed, 1, 0xffffffffu, "");
    REQUIRE(parses(app, {}));
    CHECK(fov == 35.0);
    CHECK(seed == 7);
    REQUIRE(parses(app, {"--fov", "170", "--seed", "4294967295"}));
    CHECK(fov == 170.0);
    CHECK(seed == 0xffffffffu);
    for (const char* text : {"0", "171", "-5", "nan", "inf", "", "1x", "1,2"}) {
        CAPTURE(text);
        CHECK_FALSE(parses(app, {"--fov", text}));
    }
    for (const char* text : {"0", "-1", "4294967296", "1.0", "", "0x1", " 1"}) {
        CAPTURE(text);
        CHECK_FALSE(parses(app, {"--seed", text}));
    }
    CHECK(app.help().find("35") != std::string::npos);
}

TEST_CASE("an image size is WxH within bounds") {
    CLI::App app;
    ImageSize size{640, 480};
    add_image_size(app, "--size", size, "");
    REQUIRE(parses(app, {"--size", "1x16384"}));
    CHECK(size.width == 1);
    CHECK(size.height == 16384);
    for (const char* text : {"", "x", "640", "640x", "x480", "640X480", "0x480", "640x0", "-1x2",
                             "640x480x3", "640 x 480", "16385x1", "1e3x1"}) {
        CAPTURE(text);
        CHECK_FALSE(parses(app, {"--size", text}));
    }
}

TEST_CASE("a color is in digits or a name, and only a background may be transparent") {
    CLI::App app;
    std::optional<Color> color, background;
    bool is_none = false;
    add_color(app, "--color", color, "");
    add_background(app, "--background", background, is_none, "");
    REQUIRE(parses(app, {"--color", "#FfE8d0", "--background", "#12345678"}));
    CHECK(color == Color{255, 232, 208});
    CHECK(background == Color{0x12, 0x34, 0x56, 0x78});
    CHECK_FALSE(is_none);
    background.reset();
    for (const char* text : {"none", "transparent"}) {
        REQUIRE(parses(app, {"--background", text}));
        CHECK(is_none);
        CHECK_FALSE(background);
    }
    REQUIRE(parses(app, {"--color", "#ffffffff"}));
    for (const char* text : {"none", "transparent", "#ffffff80", "#fff8", "", "#", "blu"}) {
        CAPTURE(text);
        CHECK_FALSE(parses(app, {"--color", text}));
    }
}
