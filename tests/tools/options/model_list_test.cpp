#include "tools/options/model_list.h"

#include <doctest/doctest.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "tools/options/picture_options.h"

namespace rimline::tools {
namespace {

// Without this a message of progress would stand at the end of one part while the next one is at work.
TEST_CASE("each part of loading a scene is told before it begins") {
    CLI::App app("", "test");
    ModelList models;
    PictureOptions picture;
    models.add_to(app);
    picture.add_camera_to(app);
    models.add_to_camera(app);
    app.parse("shape:knot:2000 shape:box --at 1,2,3 --subdivide 1");
    models.settle(picture, {});

    std::vector<std::string> parts;
    const MeshSource source = models.load(picture, {}, [&](const std::string& task) {
        parts.push_back(task);
        return LongCall{};
    });
    CHECK(source.triangles.size() > 4 * 2000);
    const std::vector<std::string> expected{"making shape:knot:2000", "subdividing shape:knot:2000",
                                            "comparing the faces of shape:knot:2000"};
    REQUIRE(parts.size() > expected.size());
    CHECK(std::ranges::equal(expected, std::vector(parts.begin(), parts.begin() + 3)));
    CHECK(parts.back() == "placing the models");
}

}  // namespace
}  // namespace rimline::tools
