#include "silhouette/mesh/creases.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stop_token>

#include "silhouette/error.h"
#include "silhouette/mesh/clear_creases.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

constexpr float k_degree = std::numbers::pi_v<float> / 180.0f;

// Two triangles over the edge from 0 to 1, the second bent up by an angle against the first.
MeshSource hinge(float bend_rad, bool second_turned) {
    MeshSource source;
    source.positions = {
        {0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, -std::cos(bend_rad), std::sin(bend_rad)}};
    source.triangles = {{0, 1, 2}, {1, 0, 3}};
    if (second_turned) source.triangles[1] = {0, 1, 3};
    return source;
}

TEST_CASE("a cube's twelve edges are creases of a right angle, its diagonals none") {
    const Mesh cube(make_built_in_shape("box", 12));
    const std::vector<Crease> creases = find_creases(cube, 10 * k_degree);
    CHECK(creases.size() == 12);
    for (const Crease& crease : creases)
        CHECK(crease.bend_rad == doctest::Approx(90 * k_degree).epsilon(1e-6));
    CHECK(find_creases(cube, 91 * k_degree).empty());
}

TEST_CASE("an edge bends by its dihedral angle, up or down, whichever way its faces run") {
    for (const float degrees : {0.01f, 1.0f, 30.0f, 90.0f, 150.0f, 179.9f})
        for (const float sign : {1.0f, -1.0f})
            for (const bool second_turned : {false, true}) {
                CAPTURE(degrees);
                CAPTURE(second_turned);
                const Mesh mesh(hinge(sign * degrees * k_degree, second_turned));
                const std::vector<Crease> creases = find_creases(mesh, 0.5f * degrees * k_degree);
                REQUIRE(creases.size() == 1);
                CHECK(mesh.edge_class(creases[0].edge) ==
                      (second_turned ? EdgeClass::inconsistent : EdgeClass::regular));
                CHECK(creases[0].bend_rad == doctest::Approx(degrees * k_degree).epsilon(1e-4));
            }
}

TEST_CASE("borders, plane surfaces and faces without a normal have no creases") {
    CHECK(find_creases(Mesh(MeshSource{}), 0.0f).empty());
    CHECK(find_creases(Mesh(MeshSource{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}), 0.0f)
              .empty());
    CHECK(find_creases(Mesh(hinge(0.0f, false)), 0.0f).empty());
    MeshSource needle = hinge(1.0f, false);
    needle.positions[3] = {0.25f, 0, 0};
    CHECK(find_creases(Mesh(needle), 0.0f).empty());
}

TEST_CASE("a sheet that stands on another is a crease, the same sheet twice is none") {
    MeshSource source = hinge(0.0f, false);
    source.positions.emplace_back(0.5f, 0.0f, 1.0f);
    source.triangles.push_back({0, 1, 4});
    const Mesh standing(source);
    const std::vector<Crease> creases = find_creases(standing, 10 * k_degree);
    REQUIRE(creases.size() == 1);
    CHECK(standing.edge_class(creases[0].edge) == EdgeClass::nonmanifold);
    CHECK(creases[0].bend_rad == doctest::Approx(90 * k_degree).epsilon(1e-6));

    source.positions[4] = {0.6f, 2, 0};
    CHECK(find_creases(Mesh(source), 10 * k_degree).empty());
}

TEST_CASE("creases come sharpest first, and a greater angle takes fewer from the front") {
    const Mesh mesh(make_built_in_shape("scene", 4000));
    const std::vector<Crease> all = find_creases(mesh, 1 * k_degree);
    CHECK(all.size() > 100);
    CHECK(std::ranges::is_sorted(all, std::ranges::greater{}, &Crease::bend_rad));
    for (const float degrees : {5.0f, 20.0f, 60.0f}) {
        const std::vector<Crease> some = find_creases(mesh, degrees * k_degree);
        REQUIRE(some.size() < all.size());
        for (std::size_t i = 0; i < some.size(); ++i) CHECK(some[i].edge == all[i].edge);
        CHECK(all[some.size()].bend_rad < degrees * k_degree);
    }
}

// Most edges are decided by a cosine, which must not lose one that bends by exactly the angle.
TEST_CASE("creases are the edges whose bend is at least the angle, to its last bit") {
    for (const char* name : {"scene", "knot", "terrain"}) {
        CAPTURE(name);
        const Mesh mesh(make_built_in_shape(name, 2000));
        std::vector<float> bends;
        for (std::uint32_t e = 0; e < mesh.edges_of_class(EdgeClass::border).first; ++e)
            bends.push_back(static_cast<float>(bend_of(mesh, EdgeId{e})));
        for (std::size_t i = 0; i < bends.size(); i += 97)
            for (const float angle : {bends[i], std::nextafter(bends[i], 4.0f)}) {
                const auto expected = std::ranges::count_if(
                    bends, [&](float bend) { return bend >= angle && bend > 0.0f; });
                CHECK(find_creases(mesh, angle).size() == std::size_t(expected));
            }
    }
}

TEST_CASE("a search for creases that is asked to stop says so") {
    const Mesh mesh(make_built_in_shape("scene", 4000));
    std::stop_source stop;
    CHECK(!clear_crease_flags(mesh, 30 * k_degree, stop.get_token()).empty());
    const std::vector<Crease> creases = find_creases(mesh, 30 * k_degree);
    stop.request_stop();
    CHECK_THROWS_WITH_AS(find_creases(mesh, 30 * k_degree, stop.get_token()), "cancelled", Error);
    CHECK_THROWS_WITH_AS(clear_creases(mesh, creases, stop.get_token()), "cancelled", Error);
}

}  // namespace
}  // namespace rimline
