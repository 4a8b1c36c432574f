#include "silhouette/points/thesis_supplements.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "tests/silhouette/points/made_neighborhood.h"

namespace rimline {
namespace {

using tests::at_deg;
using tests::fan_of;
using tests::MadeNeighborhood;

const glm::dvec3 k_flat_normal(0.0, 0.0, 1.0), k_upright_normal(0.0, 1.0, 0.0);

// In the plane y = 0, from the x axis to the z axis.
glm::dvec3 upright(double angle_deg, double radius = 1.0) {
    const glm::dvec3 flat = at_deg(angle_deg, radius);
    return {flat.x, 0.0, flat.y};
}

PointFans fans_of(std::initializer_list<const char*> texts) {
    PointFans fans;
    for (const char* text : texts) fans.fans[fans.count++] = fan_of(text);
    return fans;
}

// The umbrellas after the pass, where the neighbors at these places are trustworthy.
std::string supplemented_to(const std::vector<glm::dvec3>& neighbors, const PointFans& first,
                            const std::vector<std::pair<std::size_t, glm::dvec3>>& trusted,
                            double radius = 0.4) {
    const MadeNeighborhood made(neighbors);
    std::vector<glm::dvec3> normals(neighbors.size(), glm::dvec3(0.0));
    for (const auto& [place, normal] : trusted) normals[place] = normal;
    return tests::text_of(supplemented(made.around, first, normals, radius, {}).all());
}

// Two half planes that meet along the x axis: places 2 and 3 lie in one, 4 and 5 in the other.
std::vector<glm::dvec3> two_half_planes() {
    return {at_deg(0), at_deg(180), at_deg(300), at_deg(240), upright(60), upright(120)};
}

TEST_CASE("a trustworthy neighbor gives a point at a crease its second umbrella") {
    CHECK(supplemented_to(two_half_planes(), fans_of({"0 | 1 3 2"}), {{4, k_upright_normal}},
                          100.0) == "0 | 1 3 2, 0 | 1 5 4");
    CHECK(supplemented_to(two_half_planes(), fans_of({"0 | 1 3 2"}), {}, 100.0) == "0 | 1 3 2");
}

TEST_CASE("the normal of a neighbor inside an umbrella is not used") {
    CHECK(supplemented_to(two_half_planes(), fans_of({"0 | 1 3 2"}), {{2, k_upright_normal}},
                          100.0) == "0 | 1 3 2");
}

TEST_CASE("a second umbrella takes no neighbor from inside the first") {
    // The planes meet at 140 degrees: the neighbors of the first are admissible about the normal of the
    // second, where they are near, and are so here. Those of the second are farther away.
    const glm::dvec3 tilted(0.0, -std::sin(glm::radians(40.0)), std::cos(glm::radians(40.0)));
    const auto raised = [&](double angle_deg) {
        const glm::dvec3 flat = at_deg(angle_deg, 1.2);
        return glm::dvec3(flat.x, flat.y * tilted.z, -flat.y * tilted.y);
    };
    const std::vector<glm::dvec3> neighbors{at_deg(0),   at_deg(180), at_deg(300),
                                            at_deg(240), raised(60),  raised(120)};
    CHECK(supplemented_to(neighbors, fans_of({}), {{4, tilted}}, 0.55) == "0 4 5 1 3 2");
    CHECK(supplemented_to(neighbors, fans_of({"0 | 1 3 2"}), {{4, tilted}}, 0.55) ==
          "0 | 1 3 2, 0 4 5 1 |");
}

TEST_CASE("nor one that the first would admit, though it is not in its ring") {
    std::vector<glm::dvec3> neighbors = two_half_planes();
    neighbors.push_back(at_deg(90, 1.0, 0.3));  // At 17 degrees to the first plane.
    const PointFans first = fans_of({"0 | 1 3 2"});
    const glm::dvec3 tilted(0.0, -std::sin(0.3), std::cos(0.3));
    CHECK(supplemented_to(neighbors, first, {{6, tilted}}) == "0 | 1 3 2");
}

TEST_CASE("nor one of its ring that it would not admit") {
    std::vector<glm::dvec3> neighbors = two_half_planes();
    neighbors[2] = {0.5, -0.2, -0.85};
    neighbors.push_back(at_deg(210));
    neighbors.push_back(at_deg(270));
    CHECK(supplemented_to(neighbors, fans_of({"0 | 1 6 3 7 2"}), {{4, k_upright_normal}}) ==
          "0 | 1 6 3 7 2, 0 | 1 5 4");
}

TEST_CASE("a neighbor on two boundaries is in no third umbrella") {
    // Three planes through the x axis. Place 0 lies on it, and on the boundaries of the umbrellas in two.
    const glm::dvec3 third = glm::normalize(glm::dvec3(0.0, 1.0, -1.0));
    const auto in_third = [](double x) {
        return glm::dvec3(x, -std::sqrt(0.375), -std::sqrt(0.375));
    };
    const std::vector<glm::dvec3> neighbors{at_deg(0),   at_deg(45),    at_deg(90),    upright(45),
                                            upright(90), in_third(0.5), in_third(-0.5)};
    const PointFans one = fans_of({"0 1 2 |"}), two = fans_of({"0 1 2 |", "0 | 4 3"});
    CHECK(supplemented_to(neighbors, one, {{5, third}}) == "0 1 2 |, 0 5 6 |");
    CHECK(supplemented_to(neighbors, two, {{5, third}}) == "0 1 2 |, 0 | 4 3, 5 6 |");
}

TEST_CASE(
    "a new umbrella without boundary is dropped if it has the fewest points, else it alone stays") {
    const PointFans first = fans_of({"0 1 2 3 |"});
    const std::vector<glm::dvec3> flat{at_deg(30), at_deg(70), at_deg(110), at_deg(150)};
    std::vector<glm::dvec3> three = flat, four = flat;
    for (const double angle : {90.0, 210.0, 330.0}) three.push_back(upright(angle));
    for (const double angle : {60.0, 150.0, 240.0, 330.0}) four.push_back(upright(angle));
    CHECK(supplemented_to(three, first, {{4, k_upright_normal}}) == "0 1 2 3 |");
    CHECK(supplemented_to(four, first, {{4, k_upright_normal}}) == "4 7 6 5");
    CHECK(supplemented_to(three, fans_of({}), {{4, k_upright_normal}}) == "4 6 5");
}

TEST_CASE("the nearest trustworthy neighbor comes first") {
    const std::vector<glm::dvec3> neighbors = two_half_planes();
    CHECK(supplemented_to(neighbors, fans_of({}), {{2, k_flat_normal}, {4, k_upright_normal}}) ==
          "0 | 1 3 2, 0 | 1 5 4");
    CHECK(supplemented_to(neighbors, fans_of({}), {{0, k_upright_normal}, {2, k_flat_normal}}) ==
          "0 | 1 5 4, 0 | 1 3 2");
}

TEST_CASE("no umbrella is added once every boundary edge is on two boundaries, or to four") {
    std::vector<glm::dvec3> neighbors = two_half_planes();
    neighbors.push_back({0.0, 0.6, 0.8});
    neighbors.push_back({0.0, -0.6, 0.8});
    const glm::dvec3 side(1.0, 0.0, 0.0);
    CHECK(supplemented_to(neighbors, fans_of({"0 | 1 3 2"}), {{6, side}}) == "0 | 1 3 2, 6 7 |");
    CHECK(supplemented_to(neighbors, fans_of({"0 | 1 3 2", "0 | 1 5 4"}), {{6, side}}) ==
          "0 | 1 3 2, 0 | 1 5 4");
    const PointFans four = fans_of({"0 | 2", "1 | 3", "0 | 4", "1 | 5"});
    CHECK(supplemented_to(neighbors, four, {{6, side}}) == "0 | 2, 1 | 3, 0 | 4, 1 | 5");
}

}  // namespace
}  // namespace rimline
