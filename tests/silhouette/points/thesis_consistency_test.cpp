#include "silhouette/points/thesis_consistency.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/silhouette/points/made_neighborhood.h"

namespace rimline {
namespace {

using tests::at_deg;
using tests::fan_of;
using tests::MadeNeighborhood;
using tests::places;

// The umbrellas after the pass; nothing where the point does not change.
std::string corrected(const std::vector<glm::dvec3>& neighbors,
                      std::initializer_list<const char*> umbrellas, const NeighborClaims& claims) {
    const MadeNeighborhood made(neighbors);
    PointFans fans;
    for (const char* text : umbrellas) fans.fans[fans.count++] = fan_of(text);
    const auto changed = made_consistent(made.around, fans, claims);
    return changed ? tests::text_of(changed->all()) : "";
}

// Six neighbors around the point in the plane z = 0, 60 degrees from each other.
std::vector<glm::dvec3> hexagon() {
    std::vector<glm::dvec3> neighbors;
    for (int i = 0; i < 6; ++i) neighbors.push_back(at_deg(60.0 * i));
    return neighbors;
}
std::vector<glm::dvec3> hexagon_and(const std::vector<glm::dvec3>& more) {
    std::vector<glm::dvec3> neighbors = hexagon();
    neighbors.insert(neighbors.end(), more.begin(), more.end());
    return neighbors;
}
constexpr const char* k_whole = "0 1 2 3 4 5";
constexpr const char* k_half = "0 1 2 3 |";

TEST_CASE("a neighbor claims the point if it has it in a ring, leads to it from the end of a gap") {
    PointFans of_neighbor;
    of_neighbor.set(fan_of("3 5 7 |"));
    const auto claims = [&](std::size_t at) {
        NeighborClaims added;
        added.add(2, of_neighbor, at);
        return std::vector{added.reciprocal, added.incoming, added.opening};
    };
    const std::uint64_t two = places({2});
    CHECK(claims(4) == std::vector<std::uint64_t>{0, 0, 0});
    CHECK(claims(5) == std::vector<std::uint64_t>{two, 0, 0});
    CHECK(claims(3) == std::vector<std::uint64_t>{two, two, two});
    CHECK(claims(7) == std::vector<std::uint64_t>{two, two, two});
    // A point with shared boundary edges alone is accepted. It opens no other.
    of_neighbor.fans[of_neighbor.count++] = fan_of("3 9 7 |");
    CHECK(claims(9) == std::vector<std::uint64_t>{two, 0, 0});
    CHECK(claims(3) == std::vector<std::uint64_t>{two, two, 0});
    // One that is not accepted opens others with its shared edges, too.
    of_neighbor.fans[1] = fan_of("3 9 11 |");
    CHECK(claims(3) == std::vector<std::uint64_t>{two, two, two});
}

TEST_CASE("a point without umbrellas stays so") {
    CHECK(corrected(hexagon(), {}, {places({0, 1, 2}), places({0, 2}), places({0, 2})}).empty());
}

TEST_CASE("an umbrella that folds onto itself has no normal, and stays so") {
    const std::vector<glm::dvec3> neighbors{
        {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {-1, 0, 0}, {1, -1, 0}};
    CHECK(corrected(neighbors, {"0 1 | 2 3 |"}, {places({4}), 0, 0}) == "");
    CHECK(corrected(neighbors, {"0 1 | 2 3 |"}, {places({4}), places({4}), 0}) == "");
}

TEST_CASE("a point whose open boundary edges are all returned does not change") {
    const std::uint64_t reciprocal = places({0, 1, 2, 3, 4, 5});
    CHECK(corrected(hexagon(), {k_half}, {reciprocal, places({0, 3}), 0}).empty());
    CHECK(corrected(hexagon(), {k_half}, {reciprocal, places({0, 3, 4}), 0}).empty());
    CHECK_FALSE(corrected(hexagon(), {k_half}, {reciprocal, 0, 0}).empty());
}

// Two half planes at a right angle, which meet along the x axis: 0 to 2 lie in z = 0, 0, 3 and 4 in y = 0. As
// 4 leans over, it is in the gap of the umbrella in z = 0.
std::vector<glm::dvec3> folded() {
    return {at_deg(0), at_deg(60), at_deg(120), {0.5, -0.1, 0.8}, {-0.5, 0.0, 0.8}};
}

TEST_CASE("a point whose boundary edges are all shared does not change, whatever leads to it") {
    const std::vector<glm::dvec3> neighbors = hexagon_and({{0.5, 0.0, 0.8}, {-0.5, 0.0, 0.8}});
    const std::uint64_t all = places({0, 1, 2, 3, 4, 5, 6, 7});
    CHECK(corrected(neighbors, {k_half, "0 6 7 3 |"}, {all, 0, 0}).empty());
    CHECK(
        corrected(neighbors, {k_half, "0 6 7 3 |"}, {all, places({1, 2}), places({1, 2})}).empty());
    // One open edge is enough.
    CHECK_FALSE(corrected(neighbors, {k_half, "0 6 7 |"}, {all, 0, 0}).empty());
}

TEST_CASE("a point without boundary opens between two points that lead to it") {
    CHECK(corrected(hexagon(), {k_whole}, {places({0, 3, 4, 5}), places({0, 3}), places({0, 3})}) ==
          "0 | 3 4 5");
    CHECK(corrected(hexagon(), {k_whole}, {places({0, 1, 2, 3}), places({0, 3}), places({0, 3})}) ==
          k_half);
}

TEST_CASE("one is not enough, nor are two that are accepted") {
    CHECK(corrected(hexagon(), {k_whole}, {places({0}), places({0}), places({0})}).empty());
    CHECK(corrected(hexagon(), {k_whole}, {places({0, 3}), places({0, 3}), places({0})}).empty());
}

TEST_CASE(
    "it opens where the fewest reciprocal edges are, then the fewest edges, then the widest") {
    const std::uint64_t two = places({0, 3}), near = places({0, 2});
    CHECK(corrected(hexagon(), {k_whole}, {places({0, 1, 3, 4, 5}), two, two}) == "0 | 3 4 5");
    CHECK(corrected(hexagon(), {k_whole}, {places({0, 1, 2, 3, 5}), two, two}) == k_half);
    CHECK(corrected(hexagon(), {k_whole}, {places({0, 2}), near, near}) == "0 | 2 3 4 5");
    CHECK(corrected(hexagon(), {k_whole}, {places({0, 1, 2}), near, near}) == "0 1 2 |");
    for (const double angle : {170.0, 190.0}) {
        std::vector<glm::dvec3> neighbors = hexagon();
        neighbors[3] = at_deg(angle);
        CHECK(corrected(neighbors, {k_whole}, {two, two, two}) ==
              (angle > 180.0 ? "0 | 3 4 5" : k_half));
    }
}

TEST_CASE("it does not open between two that follow each other in its ring") {
    const std::uint64_t two = places({0, 1});
    CHECK(corrected(hexagon(), {k_whole}, {places({0, 1, 2, 3, 4, 5}), two, two}) == "0 1 |");
}

TEST_CASE("a neighbor that leads to it and is not in its ring joins it") {
    const std::uint64_t two = places({3, 6});
    CHECK(corrected(hexagon_and({at_deg(30)}), {k_whole}, {places({0, 3, 4, 5, 6}), two, two}) ==
          "0 6 | 3 4 5");
}

TEST_CASE("a gap moves to incoming edges: where it was, though other places cost less") {
    CHECK(corrected(hexagon(), {k_half}, {places({1, 2, 0, 3}), places({1, 2}), 0}) == "1 2 |");
    CHECK(corrected(hexagon(), {k_half}, {0, places({4, 5}), 0}) == "0 1 2 3 4 | 5");
    CHECK(corrected(hexagon(), {k_half}, {0, places({0, 4}), 0}) == "0 1 2 3 4 |");
    CHECK(corrected(hexagon(), {k_half}, {0, places({0, 2}), 0}) == "0 1 2 |");
}

TEST_CASE("it moves where the fewest reciprocal edges are removed") {
    // From 1 to 4 and from 4 to 2 it removes one edge each: 0, or 3.
    const std::uint64_t incoming = places({1, 2, 4});
    CHECK(corrected(hexagon(), {k_half}, {places({0}), incoming, 0}) == "0 1 2 | 4");
    CHECK(corrected(hexagon(), {k_half}, {places({3}), incoming, 0}) == "1 2 3 4 |");
    // Neighbors in the gap are not removed by it.
    CHECK(corrected(hexagon_and({at_deg(280), at_deg(290)}), {k_half},
                    {places({3, 6, 7}), incoming, 0}) == "1 2 3 4 |");
}

TEST_CASE("what was a gap and is none has its reciprocal edges") {
    CHECK(corrected(hexagon_and({at_deg(210), at_deg(220)}), {k_half},
                    {places({6}), places({4, 5}), 0}) == "0 1 2 3 6 4 | 5");
}

TEST_CASE("a sector of half a turn that is left stays a gap") {
    CHECK(corrected(hexagon(), {"0 1 |"}, {places({2}), 0, 0}) == "0 1 2 |");
    CHECK(corrected(hexagon(), {"0 1 |"}, {places({2, 4}), 0, 0}) == "0 1 2 4");
}

TEST_CASE("one incoming edge replaces the nearer end of the gap, or takes the gap to it") {
    CHECK(corrected(hexagon(), {k_half}, {0, places({4}), 0}) == "0 1 2 3 4 |");
    CHECK(corrected(hexagon(), {k_half}, {0, places({5}), 0}) == "0 1 2 3 | 5");
    CHECK(corrected(hexagon_and({at_deg(210)}), {k_half}, {places({5, 6}), places({4}), 0}) ==
          "0 1 2 3 6 4 |");
    // Outside the gap: the neighbors on the side with fewer reciprocal edges go, then on that with fewer.
    CHECK(corrected(hexagon(), {k_half}, {0, places({2}), 0}) == "0 1 2 |");
    CHECK(corrected(hexagon(), {k_half}, {places({3}), places({2}), 0}) == "2 3 |");
}

TEST_CASE("one incoming edge at an end of the gap changes nothing") {
    CHECK(corrected(hexagon(), {k_half}, {places({0, 1, 2, 3, 4, 5}), places({0}), 0}).empty());
}

TEST_CASE("a gap that nothing leads to is filled with reciprocal edges, if there are any") {
    CHECK(corrected(hexagon(), {k_half}, {places({4, 5}), 0, 0}) == k_whole);
    CHECK(corrected(hexagon(), {k_half}, {places({4}), 0, 0}) == "0 1 2 3 4");
    CHECK(corrected(hexagon(), {k_half}, {0, 0, 0}).empty());
    // Those outside the gap do not join the ring.
    CHECK(corrected(hexagon_and({at_deg(30)}), {k_half}, {places({0, 1, 2, 3, 6}), 0, 0}).empty());
    CHECK(corrected(hexagon_and({at_deg(30)}), {k_half}, {places({4, 6}), 0, 0}) == "0 1 2 3 4");
}

TEST_CASE("a gap whose ends are returned stays, while another of the umbrella is filled") {
    const std::vector<glm::dvec3> neighbors = hexagon_and({at_deg(330)});
    CHECK(corrected(neighbors, {"0 1 2 | 3 4 5 |"}, {places({6}), places({2, 3}), 0}) ==
          "0 1 2 | 3 4 5 6");
    CHECK(corrected(neighbors, {"0 1 2 | 3 4 5 |"}, {0, places({2, 3}), 0}).empty());
    CHECK(corrected(neighbors, {"0 1 2 | 3 4 5 |"}, {places({6}), places({2, 3, 0}), 0}).empty());
}

TEST_CASE("what is filled has triangles up to half a turn wide") {
    CHECK(corrected({at_deg(0), at_deg(60), at_deg(120), at_deg(200)}, {"0 1 2 |"},
                    {places({3}), 0, 0}) == "0 1 2 3");
}

TEST_CASE("a gap stays open beside a shared edge, where the rest of it is filled") {
    // The second umbrella shares 0 alone.
    const std::vector<glm::dvec3> neighbors = hexagon_and({{0.5, 0.0, 0.8}, {-0.5, 0.0, 0.8}});
    CHECK(corrected(neighbors, {k_half, "0 6 7 |"}, {places({4, 5}), 0, 0}) ==
          "0 1 2 3 4 5 |, 0 6 7 |");
    CHECK(corrected(neighbors, {k_half, "0 6 7 |"}, {0, 0, 0}).empty());
    // A shared edge may be returned, too.
    CHECK(corrected(neighbors, {k_half, "0 6 7 |"}, {places({4, 5}), places({0}), 0}) ==
          "0 1 2 3 4 5 |, 0 6 7 |");
}

TEST_CASE("a gap with a shared end moves with this end") {
    std::vector<glm::dvec3> neighbors = hexagon_and({{0.5, 0.0, 0.8}, {-0.5, 0.0, 0.8}});
    neighbors[4] = at_deg(220);
    neighbors[5] = at_deg(320);
    CHECK(corrected(neighbors, {k_half, "0 6 7 |"}, {0, places({4, 5}), 0}) ==
          "0 1 2 3 4 5 |, 0 6 7 |");
    CHECK(corrected(neighbors, {k_half, "0 6 7 |"}, {0, places({2}), 0}) == "0 1 2 |, 0 6 7 |");
}

TEST_CASE(
    "an umbrella may take the open edge of another, and then the other has no open edge to "
    "change") {
    CHECK(corrected(folded(), {"0 1 2 |", "0 3 4 |"}, {places({2, 4}), 0, 0}) ==
          "0 1 2 4 |, 0 3 4 |");
}

TEST_CASE(
    "it takes no neighbor from inside another, and none that is nearer to the other's plane") {
    CHECK(corrected(folded(), {"0 1 2 |", "0 3 4 |"}, {places({3}), 0, 0}).empty());
    std::vector<glm::dvec3> neighbors = folded();
    // Nearer to the plane of the first than to that of the second, which has it.
    neighbors[3] = {0.5, -0.5, 0.15};
    neighbors.push_back({0.8, 0.0, 0.6});
    neighbors.push_back({-0.2, 0.0, 1.0});
    CHECK(corrected(neighbors, {"0 1 2 |", "0 5 3 6 4 |"}, {places({3}), 0, 0}) == "");
    neighbors = folded();
    neighbors.push_back(at_deg(200, 0.9, 0.1));
    CHECK(corrected(neighbors, {"0 1 2 |", "0 3 4 |"}, {places({5}), 0, 0}) ==
          "0 1 2 5 |, 0 3 4 |");
    neighbors.back() = {-0.9, -0.1, 0.3};
    CHECK(corrected(neighbors, {"0 1 2 |", "0 3 4 |"}, {places({5}), 0, 0}) ==
          "0 1 2 |, 0 3 4 5 |");
}

TEST_CASE(
    "an umbrella that gets whole is dropped if it has the fewest points, else it alone stays") {
    // The second umbrella is upright.
    std::vector<glm::dvec3> neighbors = hexagon();
    for (int i = 0; i < 7; ++i) {
        const glm::dvec3 flat = at_deg(15.0 + 20.0 * i);
        neighbors.push_back({flat.x, 0.05, flat.y});
    }
    const std::uint64_t reciprocal = places({4, 5});
    CHECK(corrected(neighbors, {k_half, "6 7 8 9 10 11 |"}, {reciprocal, 0, 0}) == k_whole);
    CHECK(corrected(neighbors, {k_half, "6 7 8 9 10 11 12 |"}, {reciprocal, 0, 0}) ==
          "6 7 8 9 10 11 12 |");
}

}  // namespace
}  // namespace rimline
