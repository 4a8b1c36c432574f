#include "tools/output/page_doubles.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "tests/tools/output/made_page_line.h"

using namespace rimline;
using tests::page_line;
using tools::PageLine;

namespace {

using Points = std::vector<glm::dvec2>;
using PenLines = std::vector<PageLine>;

constexpr double k_reach = 0.5;

PageLine visible(const Points& points) { return page_line(false, points); }
PageLine hidden(const Points& points) { return page_line(true, points); }

PenLines without_doubles(PenLines lines, double min_length_mm = 0.0) {
    tools::leave_out_hidden_doubles(lines, 0, k_reach, min_length_mm);
    return lines;
}

double distance_to(const PageLine& line, const glm::dvec2& place) {
    double nearest = std::numeric_limits<double>::infinity();
    const std::size_t count = line.points.size();
    for (std::size_t i = 0; i + (line.is_closed ? 0 : 1) < count; ++i) {
        const glm::dvec2 a = line.points[i], way = line.points[(i + 1) % count] - a;
        const double share = std::clamp(glm::dot(place - a, way) / glm::dot(way, way), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(place, a + share * way));
    }
    return nearest;
}

double distance_to(const PenLines& lines, const glm::dvec2& place) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const PageLine& line : lines) nearest = std::min(nearest, distance_to(line, place));
    return nearest;
}

}  // namespace

TEST_CASE("a hidden line beside a visible one is left out, and one further away is not") {
    const PenLines lines =
        without_doubles({visible({{0, 0}, {20, 0}}), hidden({{2, 0.4}, {9, 0.4}}),
                         hidden({{2, -0.6}, {9, -0.6}}), hidden({{2, 0}, {9, 0}})});
    REQUIRE(lines.size() == 2);
    CHECK_FALSE(lines[0].is_hidden);
    CHECK(lines[1].points == Points{{2, -0.6}, {9, -0.6}});
}

TEST_CASE("hidden lines beside visible ones are found wherever they are on the page") {
    const PageLine corner = visible({{-3, -3}, {-2, -3}});
    for (int i = 0; i < 100; ++i) {
        const double y = 0.02 * i;
        CAPTURE(y);
        CHECK(without_doubles(
                  {corner, visible({{0, y}, {20, y}}), hidden({{2, y + 0.49}, {9, y + 0.49}})})
                  .size() == 2);
    }
}

TEST_CASE("visible lines stay beside each other") {
    CHECK(without_doubles({visible({{0, 0}, {20, 0}}), visible({{2, 0.4}, {9, 0.4}})}).size() == 2);
}

TEST_CASE("of hidden lines beside each other the longest stays") {
    const PenLines lines = without_doubles(
        {hidden({{2, 0.4}, {9, 0.4}}), hidden({{0, 0}, {20, 0}}), hidden({{3, -0.4}, {11, -0.4}})});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].points == Points{{0, 0}, {20, 0}});
}

TEST_CASE("what was left out covers nothing") {
    // The second is beside the first, the third only beside the second.
    const PenLines lines = without_doubles(
        {visible({{0, 0}, {20, 0}}), hidden({{1, 0.4}, {18, 0.4}}), hidden({{2, 0.8}, {9, 0.8}})});
    REQUIRE(lines.size() == 2);
    CHECK(lines[1].points == Points{{2, 0.8}, {9, 0.8}});
}

TEST_CASE("lines that cross or meet others stay whole") {
    const Points crossing{{-10, -6}, {10, 6}}, meeting{{0, 8}, {0, 0}}, slanted{{3, 5}, {0, 0}};
    const PenLines lines = without_doubles(
        {visible({{-20, 0}, {20, 0}}), hidden(crossing), hidden(meeting), hidden(slanted)});
    REQUIRE(lines.size() == 4);
    CHECK(lines[1].points == crossing);
    CHECK(lines[2].points == meeting);
    CHECK(lines[3].points == slanted);
}

TEST_CASE("only what goes on behind a line's end is left of a hidden line") {
    const PenLines lines =
        without_doubles({visible({{0, 0}, {10, 0}}), hidden({{1, 0.25}, {8, 0.25}, {30, 0.25}})});
    REQUIRE(lines.size() == 2);
    REQUIRE(lines[1].points.size() == 2);
    CHECK(lines[1].points[0].x >= 10.0 - 0.13);
    CHECK(lines[1].points[0].x <= 10.0 + k_reach);
    CHECK(lines[1].points[1] == glm::dvec2(30, 0.25));
}

TEST_CASE("a hidden line that turns back on itself is drawn once") {
    // Forth, back and forth again, then on: what is left covers all of it, each place once.
    const PenLines lines =
        without_doubles({hidden({{0, 0}, {20, 0}, {6, 0.2}, {20, 0.4}, {30, 0.4}})}, 1.0);
    double length = 0.0, from = 30.0, to = 0.0;
    for (const PageLine& line : lines) {
        length += line.length_mm();
        for (const glm::dvec2& point : line.points)
            from = std::min(from, point.x), to = std::max(to, point.x);
    }
    CHECK(length > 29.5);
    CHECK(length < 32.0);
    CHECK(from == 0.0);
    CHECK(to == 30.0);
    // A bend that is wider than the reach is none, nor is a line that crosses itself.
    const Points bend{{0, 0}, {10, 0}, {10, 0.7}, {0, 0.7}}, knot{{0, 0}, {9, 0}, {6, 5}, {3, -5}};
    CHECK(without_doubles({hidden(bend)})[0].points == bend);
    CHECK(without_doubles({hidden(knot)})[0].points == knot);
}

TEST_CASE("of visible lines that are nearly one the longest stays, beside hidden ones all") {
    PenLines lines{visible({{0, 0}, {20, 0}}), visible({{2, 0.02}, {9, -0.02}}),
                   visible({{15, 0.02}, {30, 0.02}}), visible({{2, 0.06}, {9, 0.06}}),
                   hidden({{0, 0}, {20, 0}})};
    tools::leave_out_visible_doubles(lines, 0, 0.03, 0.0);
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].points == Points{{0, 0}, {20, 0}});
    CHECK(!lines[1].is_hidden);
    CHECK(lines[1].points.front().x > 19.9);
    CHECK(lines[1].points.front().x < 20.05);
    CHECK(lines[1].points.back() == glm::dvec2(30, 0.02));
    CHECK(lines[2].points == Points{{2, 0.06}, {9, 0.06}});
    CHECK(lines[3].is_hidden);
    CHECK(lines[3].points.size() == 2);
    // What is left of a line may be too short.
    PenLines rest{visible({{0, 0}, {20, 0}}), visible({{15, 0.02}, {30, 0.02}})};
    tools::leave_out_visible_doubles(rest, 0, 0.03, 12.0);
    CHECK(rest.size() == 1);
    // A corner stays one.
    PenLines corner{visible({{0, 0}, {20, 0}}), visible({{0, 0}, {20, 3}})};
    tools::leave_out_visible_doubles(corner, 0, 0.03, 0.0);
    CHECK(corner[1].points == Points{{0, 0}, {20, 3}});
}

TEST_CASE("rests keep the points of the line and short ones are left out") {
    // Beside the visible lines it is a double; the part between them is 4 mm long.
    const Points points{{0, 0.25}, {10, 0.25}, {12, 1.5}, {14, 0.25}, {24, 0.25}};
    const PenLines with = {visible({{0, 0}, {10, 0}}), visible({{14, 0}, {24, 0}}), hidden(points)};
    const PenLines lines = without_doubles(with);
    REQUIRE(lines.size() == 3);
    const Points& rest = lines[2].points;
    CHECK(std::ranges::find(rest, points[2]) != rest.end());
    CHECK(lines[2].length_mm() > 3.0);
    CHECK(lines[2].length_mm() < 5.0);
    CHECK(without_doubles(with, 5.0).size() == 2);
}

TEST_CASE("a closed hidden line is cut where it passes beside others, wherever it begins") {
    const Points corners{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    for (std::size_t start = 0; start < 4; ++start) {
        CAPTURE(start);
        Points turned = corners;
        std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(start), turned.end());
        const PenLines lines =
            without_doubles({visible({{-5, 0.3}, {15, 0.3}}), page_line(true, turned, true)});
        REQUIRE(lines.size() == 2);
        CHECK_FALSE(lines[1].is_closed);
        CHECK(lines[1].length_mm() == doctest::Approx(30.0).epsilon(0.05));
        CHECK(distance_to(lines, {5, 10}) == 0.0);
        CHECK(distance_to(lines, {10, 5}) == 0.0);
    }
    // Away from others, it stays closed.
    const PenLines lines =
        without_doubles({visible({{-5, 3}, {-5, 9}}), page_line(true, corners, true)});
    CHECK(lines[1].is_closed);
    CHECK(lines[1].points == corners);
}

TEST_CASE("whatever is left out of random bundles lies beside what stays" *
          doctest::test_suite("plain")) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0.0, 40.0), noise(-0.7, 0.7);
    std::size_t cut = 0;
    for (int round = 0; round < 60; ++round) {
        CAPTURE(round);
        PenLines lines;
        for (int bundle = 0; bundle < 3; ++bundle) {
            const glm::dvec2 from(place(random), place(random)), to(place(random), place(random));
            const double bend = 8.0 * noise(random);
            const glm::dvec2 normal = glm::normalize(glm::dvec2(from.y - to.y, to.x - from.x));
            for (int i = 0; i < 6; ++i) {
                const double aside = noise(random), begin = 0.3 * std::abs(noise(random));
                Points points;
                for (int k = 0; k <= 24; ++k) {
                    const double share = begin + (1.0 - begin) * k / 24.0;
                    points.push_back(tools::rounded_to_um(
                        glm::mix(from, to, share) +
                        (aside + 0.05 * noise(random) + bend * share * (1.0 - share)) * normal));
                }
                lines.push_back(page_line(i > 1, points, i == 3));
            }
        }
        const PenLines rest = without_doubles(lines);
        double before = 0.0, after = 0.0;
        for (const PageLine& each : lines) before += each.length_mm();
        for (const PageLine& each : rest) {
            after += each.length_mm();
            // Nothing is there that was not.
            for (const glm::dvec2& p : each.points) CHECK(distance_to(lines, p) < 1e-3);
        }
        if (after < 0.9 * before) ++cut;
        for (const PageLine& each : lines)
            for (std::size_t i = 0; i + 1 < each.points.size(); ++i)
                CHECK(distance_to(rest, glm::mix(each.points[i], each.points[i + 1], 0.37)) <=
                      1.13 * k_reach);
    }
    CHECK(cut > 40);
}
