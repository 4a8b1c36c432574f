// Chosen suns against what a single face must choose, and against a search among random lights.

#include "silhouette/field/sun_choice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/field/named_functions.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/winding.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/silhouette/mesh/small_meshes.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

Mesh one_face() { return Mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}); }

// The face's best light stands at half of alpha over it, somewhere in the shell.
void check_grazing(const ChosenSun& sun, double over) {
    CHECK(glm::length(sun.direction) == doctest::Approx(1.0));
    CHECK(sun.votes == doctest::Approx(1.0).epsilon(1e-4));
    CHECK(over > 0.5 / 2.0 - 0.02);
    CHECK(over < 0.5 / std::sqrt(3.0) + 0.02);
}

TEST_CASE("a single face is lit so that light grazes the side that is seen") {
    const Mesh mesh = one_face();
    const auto front = choose_sun(mesh, {0.2, 0.3, 5.0});
    REQUIRE(front);
    CHECK(front->faces == 1);
    CHECK_FALSE(front->sees_backs);
    check_grazing(*front, front->direction.z);
    const auto back = choose_sun(mesh, {0.2, 0.3, -5.0});
    REQUIRE(back);
    CHECK(back->faces == 1);
    CHECK(back->sees_backs);
    check_grazing(*back, -back->direction.z);
}

TEST_CASE("there is no sun for what is seen edge-on or has no planes") {
    CHECK_FALSE(choose_sun(one_face(), {5, 5, 0}));
    CHECK_FALSE(choose_sun(Mesh(MeshSource{}), {1, 2, 3}));
    CHECK_FALSE(choose_sun(Mesh({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}), {1, 2, 3}));
}

TEST_CASE("only faces towards the viewer vote and no random light has more of their votes") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const glm::dvec3 eye =
        mesh.center() + 1.9 * mesh.radius() * glm::normalize(glm::dvec3(2, 1, 2));
    const auto sun = choose_sun(mesh, eye);
    REQUIRE(sun);
    const UnitPlanes planes(mesh);
    const glm::dvec3 eye_point = planes.frame().from_model(eye);
    std::uint32_t facing = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) facing += planes.distance(i, eye_point) > 0.0;
    CHECK(sun->faces == facing);
    const TangentialFunction f = light_function();
    Random random(5);
    for (int light = 0; light < 2000; ++light) {
        const glm::dvec3 p = (1.7321 + 0.26 * std::abs(double{random.signed_unit()})) *
                             glm::normalize(glm::dvec3(random.in_cube()));
        double votes = 0.0;
        for (std::size_t i = 0; i < planes.size(); ++i)
            if (planes.distance(i, eye_point) > 0.0) votes += f.value(planes.distance(i, p));
        CHECK(votes <= 1.01 * sun->votes);
    }
}

TEST_CASE("a closed mesh that is wound inside out is lit as if it were not") {
    const Mesh mesh(make_built_in_shape("spring", 2000));
    const glm::dvec3 eye = mesh.center() + 3.0 * mesh.radius() * glm::dvec3(0.6, 0.0, 0.8);
    const auto expected = choose_sun(mesh, eye);
    const auto found = choose_sun(turned_inside_out(mesh), eye);
    REQUIRE(expected);
    REQUIRE(found);
    // Float rounding may decide a face that is seen edge-on differently.
    CHECK(std::abs(int(found->faces) - int(expected->faces)) <= 2);
    CHECK(glm::distance(found->direction, expected->direction) < 0.01);
}

}  // namespace
