#include "tools/nearest_name.h"

#include <doctest/doctest.h>

#include <array>

namespace rimline::tools {
namespace {

TEST_CASE("the edit distance counts letters inserted, deleted, replaced and swapped") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("", "ink") == 3);
    CHECK(edit_distance("ink", "") == 3);
    CHECK(edit_distance("hatch", "hatch") == 0);
    CHECK(edit_distance("HATCH", "hatch") == 0);
    CHECK(edit_distance("hatch", "hath") == 1);
    CHECK(edit_distance("hath", "hatch") == 1);
    CHECK(edit_distance("hatch", "hitch") == 1);
    CHECK(edit_distance("hatch", "htach") == 1);
    CHECK(edit_distance("kitten", "sitting") == 3);
    // A swapped pair is not edited again: the optimal string alignment, not Damerau's distance.
    CHECK(edit_distance("ca", "abc") == 3);
    for (const char* a : {"render", "redner", "animate", "views", "v"})
        for (const char* b : {"render", "redner", "animate", "views", "v"})
            CHECK(edit_distance(a, b) == edit_distance(b, a));
}

TEST_CASE("the nearest name is one that is near enough, and no name of the list has one") {
    const std::array<std::string, 5> names{"render", "animate", "info", "view", "views"};
    CHECK(nearest_name("rendr", names) == "render");
    CHECK(nearest_name("redner", names) == "render");
    CHECK(nearest_name("Animte", names) == "animate");
    CHECK(nearest_name("viewss", names) == "views");
    CHECK(nearest_name("vieww", names) == "view");  // The first of two.
    CHECK(nearest_name("views", names) == "");
    CHECK(nearest_name("frobnicate", names) == "");
    CHECK(nearest_name("x", names) == "");
    CHECK(nearest_name("", names) == "");
    CHECK(did_you_mean("ifno", names) == "; did you mean 'info'?");
    CHECK(did_you_mean("frobnicate", names) == "");
}

}  // namespace
}  // namespace rimline::tools
