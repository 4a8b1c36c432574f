#include "tools/output/stubble.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

namespace rimline::tools {
namespace {

void add_line(PictureLines& lines, std::initializer_list<glm::dvec2> points, bool is_hidden = false,
              bool is_closed = false) {
    const auto first = static_cast<std::uint32_t>(lines.points.size());
    lines.points.insert(lines.points.end(), points);
    lines.lines.push_back(
        {first, static_cast<std::uint32_t>(lines.points.size()), is_hidden, is_closed});
}

// The lengths of the lines that are left, from end to end.
std::vector<double> left(PictureLines lines, double min_length) {
    remove_stubble(lines, {.min_length = min_length, .reach = 1.0, .double_reach = 0.5});
    std::vector<double> lengths;
    for (const PictureLine& line : lines.lines)
        lengths.push_back(
            glm::distance(lines.points[line.first_point], lines.points[line.last_point - 1]));
    return lengths;
}

TEST_CASE("a short line alone is stubble, a long one is not") {
    PictureLines lines;
    add_line(lines, {{0, 0}, {9, 0}});
    add_line(lines, {{0, 9}, {10, 9}});
    CHECK(left(lines, 5.0) == std::vector<double>{10.0});
    CHECK(left(lines, 0.0).size() == 2);
    CHECK(left(lines, 5.1).empty());
}

TEST_CASE("the length of a line is that along its corners") {
    PictureLines lines;
    add_line(lines, {{0, 0}, {0, 3}, {1, 3}, {1, 0}});
    CHECK(left(lines, 3.5).size() == 1);
    CHECK(left(lines, 3.6).empty());
}

TEST_CASE("a short line between two others stays, and one that ends beside them goes") {
    PictureLines lines;
    add_line(lines, {{0, 0}, {50, 0}});
    add_line(lines, {{50, 0.5}, {50, 3}});  // The short edge of a plate.
    add_line(lines, {{0, 3}, {50, 3}});
    add_line(lines, {{25, 0}, {25, -3}});  // Begins on a line, and ends nowhere.
    add_line(lines, {{30, 0.5}, {30, 2.5}});
    CHECK(left(lines, 5.0) == std::vector<double>{50.0, 2.5, 50.0, 2.0});
}

TEST_CASE("a row of short lines goes from its free end") {
    PictureLines lines;
    add_line(lines, {{0, 0}, {50, 0}});
    for (int i = 0; i < 5; ++i) add_line(lines, {{50 + 2 * i, 0}, {52 + 2 * i, 0}});
    CHECK(left(lines, 5.0) == std::vector<double>{50.0});
}

TEST_CASE("a line that goes on from the end of a longer one is no double of it") {
    PictureLines lines;
    add_line(lines, {{0, 0}, {50, 0}});
    add_line(lines, {{50.3, 0}, {50.4, 0}, {50.7, 0.2}});
    add_line(lines, {{51, 0}, {99, 0}});
    CHECK(left(lines, 5.0).size() == 3);
}

TEST_CASE("a line that only thickens a longer one goes") {
    PictureLines lines;
    add_line(lines, {{0, 0}, {50, 0}});
    add_line(lines, {{10, 0.3}, {12, 0.4}, {30, 0.2}});
    add_line(lines, {{35, 0.3}, {45, 1.5}});
    add_line(lines, {{0, 9}, {20, 9}});
    add_line(lines, {{0, 9}, {20, 9}});  // Twice the same: one stays.
    CHECK(left(lines, 5.0).size() == 3);
}

TEST_CASE("a short closed line is stubble") {
    PictureLines lines;
    add_line(lines, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, false, true);
    CHECK(left(lines, 4.0).size() == 1);
    CHECK(left(lines, 4.1).empty());
}

TEST_CASE("hidden lines do not hold visible ones, and are held by them") {
    PictureLines lines;
    add_line(lines, {{0, 0}, {3, 0}});
    add_line(lines, {{3, 0}, {30, 0}}, true);
    add_line(lines, {{0, 0}, {0, 30}});
    CHECK(left(lines, 5.0) == std::vector<double>{27.0, 30.0});

    PictureLines behind_a_rod;
    add_line(behind_a_rod, {{0, 0}, {30, 0}});
    add_line(behind_a_rod, {{30, 0}, {33, 0}}, true);
    add_line(behind_a_rod, {{33, 0}, {60, 0}});
    CHECK(left(behind_a_rod, 5.0).size() == 3);
}

}  // namespace
}  // namespace rimline::tools
