#include "tools/output/same_picture.h"

#include <doctest/doctest.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace rimline::tools {
namespace {

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
