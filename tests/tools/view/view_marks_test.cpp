#include "tools/view/view_marks.h"

#include <doctest/doctest.h>

#include "tools/view/view_counters.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("the label of a mark lies within the window and beside the panels, and not on the mark") {
    const FreeArea area{.window = {900, 700}, .left = 320, .right = 200};
    const glm::dvec2 size(110, 16);
    for (const double x : {330.0, 500.0, 588.0, 640.0, 699.0}) {
        const glm::dvec2 corner = label_corner({x, 300}, size, area);
        CHECK(corner.x >= area.left);
        CHECK(corner.x + size.x <= 700.0);
        const bool is_beside = corner.x > x || corner.x + size.x < x;
        CHECK(is_beside);
        CHECK(corner.y < 300.0);
        CHECK(corner.y + size.y > 300.0);
    }
    CHECK(label_corner({500, 300}, size, area).x > 500.0);
}

TEST_CASE("lights are counted from 1 where the passes of a frame are shown") {
    CHECK(shown_pass_name("shadow volumes, light 0") == "shadow volumes, light 1");
    CHECK(shown_pass_name("shadow volumes, light 9") == "shadow volumes, light 10");
    CHECK(shown_pass_name("lines") == "lines");
}
