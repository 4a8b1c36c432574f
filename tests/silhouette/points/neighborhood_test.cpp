#include "silhouette/points/neighborhood.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/silhouette/points/sample_clouds.h"

namespace rimline {
namespace {

using tests::jitter;
using tests::Random;

// Ring places as given, sectors that are gaps.
Fan make_fan(const std::vector<int>& ring, const std::vector<std::size_t>& gaps) {
    Fan fan;
    for (const int place : ring) fan.ring[fan.size++] = static_cast<std::uint8_t>(place);
    for (const std::size_t sector : gaps) fan.open(sector);
    return fan;
}

bool is_same(const Fan& a, const Fan& b) {
    return a.size == b.size && a.gaps == b.gaps &&
           std::equal(a.ring.begin(), a.ring.begin() + a.size, b.ring.begin());
}

// Of points in the plane z = 0, the first in the middle: who is how far from it, nearest first.
struct Around {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> list;
    Neighborhood neighborhood;

    explicit Around(std::vector<glm::dvec3> all) : points(std::move(all)), list(points.size() - 1) {
        std::iota(list.begin(), list.end(), 1u);
        std::ranges::sort(list, {}, [&](std::uint32_t i) { return glm::length(points[i]); });
        neighborhood.assign(points, 0, list);
    }
};

TEST_CASE("a star's triangles have empty circles, and what turns by π or more is a gap") {
    Random random(3);
    for (int n = 0; n < 2000; ++n) {
        CAPTURE(n);
        // On one side of the point in every third, so that the star is open.
        std::vector<glm::dvec3> points{glm::dvec3(0.0)};
        for (int i = random.between(3, 30); i > 0; --i)
            points.push_back(
                {n % 3 == 0 ? std::abs(jitter(random)) : jitter(random), jitter(random), 0.0});
        const Around around(points);
        const Neighborhood& seen = around.neighborhood;
        const Fan star = seen.star({0.0, 0.0, 1.0}, 0.5);
        REQUIRE(star.size >= 2);
        // Counterclockwise from one direction to another.
        const auto turn_between = [](const glm::dvec3& from, const glm::dvec3& to) {
            const double turn = std::atan2(to.y, to.x) - std::atan2(from.y, from.x);
            return turn < 0.0 ? turn + 2.0 * std::numbers::pi : turn;
        };
        double turned = 0.0;
        for (std::size_t j = 0; j < star.size; ++j) {
            const glm::dvec3& a = seen.edge(star.ring[j]);
            const glm::dvec3& b = seen.edge(star.ring[star.next(j)]);
            const double turn = turn_between(a, b);
            turned += turn;
            REQUIRE(star.is_gap(j) == (turn >= std::numbers::pi));
            for (std::uint32_t place = 0; place < seen.size(); ++place) {
                const glm::dvec3& c = seen.edge(place);
                if (place == star.ring[j] || place == star.ring[star.next(j)]) continue;
                if (star.is_gap(j)) {
                    CHECK(turn_between(a, c) > turn);  // Nothing lies within.
                    continue;
                }
                // Of a counterclockwise triangle of 0, a, b: c lies in its circle.
                const double in_circle = glm::dot(c, c) * (a.x * b.y - a.y * b.x) -
                                         glm::dot(b, b) * (a.x * c.y - a.y * c.x) +
                                         glm::dot(a, a) * (b.x * c.y - b.y * c.x);
                CHECK(in_circle > -1e-12);
            }
        }
        CHECK(turned == doctest::Approx(2.0 * std::numbers::pi));
    }
}

TEST_CASE(
    "a star sees the nearer of two points in one direction and none that stand off its plane") {
    const Around around({{0, 0, 0},
                         {1, 0, 0},
                         {2, 0, 0},
                         {0, 1, 0},
                         {-1, 0, 0},
                         {0, -1, 0},
                         {0.5, 0.5, 3.0},
                         {0.4, 0.4, 0.0}});
    const Fan star = around.neighborhood.star({0.0, 0.0, 1.0}, 0.5);
    std::vector<std::uint32_t> ring;
    for (std::size_t j = 0; j < star.size; ++j)
        ring.push_back(around.neighborhood.number(star.ring[j]));
    std::ranges::sort(ring);
    CHECK(ring == std::vector<std::uint32_t>{1, 3, 4, 5, 7});
    CHECK(star.gaps == 0);
    // Among some places only.
    std::uint64_t among = 0;
    for (std::uint32_t place = 0; place < around.neighborhood.size(); ++place)
        if (around.neighborhood.number(place) != 7) among |= std::uint64_t{1} << place;
    CHECK(around.neighborhood.star({0.0, 0.0, 1.0}, 0.5, among).size == 4);
}

TEST_CASE("gaps in a row become one, round the end of the ring too") {
    Fan fan = make_fan({4, 7, 1, 9, 3, 2}, {1, 2, 4});
    merge_gaps(fan);
    CHECK(is_same(fan, make_fan({4, 7, 9, 3, 2}, {1, 3})));
    fan = make_fan({4, 7, 1, 9, 3, 2}, {0, 4, 5});
    merge_gaps(fan);
    CHECK(is_same(fan, make_fan({7, 1, 9, 3}, {3})));
    fan = make_fan({4, 7, 1}, {0, 1, 2});
    merge_gaps(fan);
    CHECK_FALSE(fan.is_umbrella());
    fan = make_fan({4, 7, 1}, {});
    merge_gaps(fan);
    CHECK(is_same(fan, make_fan({4, 7, 1}, {})));
}

TEST_CASE("an umbrella turned round has the same gaps between the same points") {
    Fan fan = make_fan({4, 7, 1, 9}, {0, 2});
    reverse(fan);
    CHECK(is_same(fan, make_fan({9, 1, 7, 4}, {0, 2})));
    fan = make_fan({4, 7, 1, 9}, {3});
    reverse(fan);
    CHECK(is_same(fan, make_fan({9, 1, 7, 4}, {3})));
    fan = make_fan({4, 7, 1}, {0});
    reverse(fan);
    CHECK(is_same(fan, make_fan({1, 7, 4}, {1})));
}

}  // namespace
}  // namespace rimline
