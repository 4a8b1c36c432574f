#include "silhouette/points/thesis_fan.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/silhouette/points/made_neighborhood.h"

namespace rimline {
namespace {

using tests::at_deg;
using tests::MadeNeighborhood;
using tests::text_of;

const glm::dvec3 k_up(0.0, 0.0, 1.0);

// The umbrella of all neighbors about the z axis.
std::string umbrella_of(const std::vector<glm::dvec3>& neighbors, double radius = 100.0,
                        const PointSurfaceOptions& options = {}) {
    const MadeNeighborhood made(neighbors);
    std::vector<std::uint8_t> all(neighbors.size());
    std::iota(all.begin(), all.end(), std::uint8_t{0});
    return text_of(thesis_fan(made.around, all, k_up, radius, options));
}

TEST_CASE("the Gabriel triangle has the smallest circle, not the nearest third corner") {
    // The corner at place 1 sees the edge to the nearest neighbor at a smaller angle than that at place 2.
    const glm::dvec3 nearest(1.0, 0.0, 0.0), third(0.5, 0.0, 1.2);
    const MadeNeighborhood made({nearest, {-1.05, 0.3, 0.0}, third, {0.0, 2.0, 0.0}});
    const GabrielTriangle triangle = gabriel_triangle(made.around, 4, std::numbers::pi / 6);
    CHECK(std::abs(triangle.normal.y) == doctest::Approx(1.0));
    const double area = glm::length(glm::cross(nearest, third)) / 2.0;
    CHECK(triangle.radius == doctest::Approx(glm::length(nearest) * glm::length(third) *
                                             glm::distance(nearest, third) / (4.0 * area)));
}

TEST_CASE("of Gabriel triangles with equal circles that with the nearer corner counts") {
    // On circles through the point and its nearest neighbor, one in each plane. That of the farther corner is
    // smaller by less than rounding is allowed to decide.
    const auto on_circle = [](double height, double turn) {
        const double radius = std::sqrt(0.25 + height * height);
        return glm::dvec3(0.5 + radius * std::sin(turn), height + radius * std::cos(turn), 0.0);
    };
    const glm::dvec3 near = on_circle(0.3, -1.0), far = on_circle(0.3 - 1e-11, 0.1);
    const MadeNeighborhood made({{1.0, 0.0, 0.0}, near, {far.x, 0.0, far.y}, {0.0, 3.0, 3.0}});
    REQUIRE(made.around.length(1) < made.around.length(2));
    CHECK(std::abs(gabriel_triangle(made.around, 4, 0.5).normal.z) == doctest::Approx(1.0));
}

TEST_CASE("a Gabriel triangle is trusted where half of the nearest lie within omega of its plane") {
    const auto is_trusted = [](const std::vector<glm::dvec3>& neighbors, std::uint32_t k) {
        const MadeNeighborhood made(neighbors);
        return gabriel_triangle(made.around, k, std::numbers::pi / 6).is_trusted;
    };
    const auto raised = [](double angle_deg) {
        return 3.0 * glm::dvec3(0.0, -std::cos(glm::radians(angle_deg)),
                                std::sin(glm::radians(angle_deg)));
    };
    const glm::dvec3 nearest(1.0, 0.0, 0.0), third(0.5, 1.0, 0.0);
    CHECK(is_trusted({nearest, third, raised(80), raised(85)}, 4));
    CHECK_FALSE(is_trusted({nearest, third, raised(31), raised(80), raised(85)}, 5));
    CHECK(is_trusted({nearest, third, raised(29), raised(80), raised(85)}, 5));
    // Only the k nearest count.
    CHECK_FALSE(is_trusted(
        {nearest, third, raised(31), raised(80), raised(85), at_deg(200, 4.0), at_deg(250, 4.0)},
        5));
}

TEST_CASE("a neighbor in the marginal band around omega is admissible where it is near") {
    const auto is_admitted = [](double angle_deg, double length) {
        const double angle = glm::radians(angle_deg);
        const MadeNeighborhood made({length * glm::dvec3(std::cos(angle), 0.0, std::sin(angle))});
        return is_admissible(made.around, 0, k_up, 1.0, {});
    };
    // Of 30 degrees, with a band of 10, and twice a radius of 1.
    CHECK(is_admitted(19.9, 50.0));
    CHECK_FALSE(is_admitted(20.1, 2.1));
    CHECK(is_admitted(20.1, 1.9));
    CHECK(is_admitted(39.9, 1.9));
    CHECK_FALSE(is_admitted(40.1, 0.1));
}

TEST_CASE("an umbrella has the admissible ones of the given neighbors, and two at least") {
    std::vector<glm::dvec3> neighbors;
    for (int i = 0; i < 6; ++i) neighbors.push_back(at_deg(60.0 * i));
    neighbors.push_back(at_deg(30.0, 0.1, 1.0));
    const MadeNeighborhood made(neighbors);
    const auto admitted = [&](std::uint64_t among) {
        const auto fan = admitted_fan(made.around, among, k_up, 10.0, {});
        return fan ? text_of(*fan) : "";
    };
    CHECK(admitted(tests::places({0, 1, 2, 3, 4, 5, 6})) == "0 1 2 3 4 5");
    CHECK(admitted(tests::places({0, 1, 2, 4, 5})) == "0 1 2 4 5");
    CHECK(admitted(tests::places({0, 6})).empty());
}

TEST_CASE("a sector wider than phi is a gap") {
    const auto with_sector = [](double angle_deg) {
        return umbrella_of({at_deg(0), at_deg(angle_deg), at_deg(220), at_deg(290)});
    };
    CHECK(with_sector(149.5) == "0 1 2 3");
    CHECK(with_sector(150.5) == "0 | 1 2 3");
}

TEST_CASE("a sector of half a turn around the normal is a gap, whatever its angle in space") {
    // The ends are raised, so that their angle in space is small.
    CHECK(umbrella_of({at_deg(0, 1.0, 2.0), at_deg(60), at_deg(115), at_deg(170, 1.0, 2.0)}) ==
          "0 1 2 3 |");
}

TEST_CASE("a neighbor whose two triangles turn by more than omega is removed") {
    std::vector<glm::dvec3> neighbors;
    for (int i = 0; i < 6; ++i) neighbors.push_back(at_deg(60.0 * i));
    neighbors.push_back(at_deg(30.0, 0.6, 0.7));
    CHECK(umbrella_of(neighbors) == "0 1 2 3 4 5");
    PointSurfaceOptions wide;
    wide.omega = glm::radians(85.0);
    CHECK(umbrella_of(neighbors, 100.0, wide) == "0 6 1 2 3 4 5");
}

TEST_CASE("a neighbor with one triangle that turns by more than omega stays") {
    // Place 0 is raised, and an end of the gap. The triangle of 0 and 1 turns by 32 degrees, that of 0 and 2
    // would by 28.
    CHECK(umbrella_of({at_deg(0, 1.0, 0.54), at_deg(60), at_deg(90), at_deg(180)}) == "0 1 2 3 |");
}

TEST_CASE("a neighbor stays where the triangle without it would turn by more than omega, too") {
    // Half of the ring is bent up by 45 degrees.
    const auto bent = [](double angle_deg) {
        const glm::dvec3 flat = at_deg(angle_deg);
        return glm::dvec3(flat.x, flat.y * std::sqrt(0.5), flat.y * std::sqrt(0.5));
    };
    CHECK(umbrella_of({at_deg(0), bent(60), bent(120), at_deg(180), at_deg(240), at_deg(300)}) ==
          "0 1 2 3 4 5");
}

TEST_CASE("a neighbor at a gap stays, whatever its triangles") {
    // Place 0 is raised: its triangle turns by 41 degrees, as would one in the gap before it.
    CHECK(umbrella_of({at_deg(0, 1.0, 0.3), at_deg(20), at_deg(80), at_deg(140), at_deg(203)}) ==
          "0 1 2 3 4 |");
}

TEST_CASE("the neighbor whose triangles turn the most is removed first") {
    // Both triangles of 6 turn by 48 degrees and more, those of 7 by 39. Without either the other has one that
    // turns by 21.
    std::vector<glm::dvec3> neighbors;
    for (int i = 0; i < 6; ++i) neighbors.push_back(at_deg(60.0 * i));
    neighbors.push_back(at_deg(13.9, 0.91, -0.25));
    neighbors.push_back(at_deg(41.6, 1.13, 0.29));
    CHECK(umbrella_of(neighbors) == "0 7 1 2 3 4 5");
}

TEST_CASE("an edge that is not Delaunay is removed") {
    std::vector<glm::dvec3> neighbors;
    for (int i = 0; i < 6; ++i) neighbors.push_back(at_deg(60.0 * i));
    neighbors.push_back(at_deg(30.0, 1.1));
    CHECK(umbrella_of(neighbors) == "0 6 1 2 3 4 5");
    neighbors.back() = at_deg(30.0, 1.2);
    CHECK(umbrella_of(neighbors) == "0 1 2 3 4 5");
}

TEST_CASE("an edge at a gap is not removed, though it is not Delaunay") {
    // The circle of 1, 4 and the point holds 0.
    CHECK(umbrella_of({at_deg(0, 3.0), at_deg(13), at_deg(80), at_deg(145), at_deg(208)}) ==
          "0 1 2 3 4 |");
}

TEST_CASE("a sector that a removal makes wider than phi is a gap") {
    CHECK(umbrella_of({at_deg(0), at_deg(80, 6.0), at_deg(155), at_deg(220), at_deg(290)}) ==
          "0 | 2 3 4");
}

TEST_CASE("a gap grows over triangles with large circles, and no other triangle is lost to one") {
    const std::vector<glm::dvec3> open{at_deg(0, 1.6), at_deg(60), at_deg(120), at_deg(180)};
    CHECK(umbrella_of(open, 0.41) == "0 1 2 3 |");  // The circle of 0 and 1 has a radius of 0.81.
    CHECK(umbrella_of(open, 0.40) == "1 2 3 |");
    std::vector<glm::dvec3> whole;
    for (int i = 0; i < 6; ++i) whole.push_back(at_deg(60.0 * i));
    CHECK(umbrella_of(whole, 0.1) == "0 1 2 3 4 5");
}

}  // namespace
}  // namespace rimline
