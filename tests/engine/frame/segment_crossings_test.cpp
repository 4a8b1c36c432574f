#include "engine/frame/segment_crossings.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/shadow_scenes.h"
#include "tests/silhouette/exact/exact_numbers.h"

namespace rimline {
namespace {

using namespace rimline::tests;

TEST_CASE(
    "a segment crosses a triangle from its front, from its back, or not, or it is not known") {
    const Corners corners{glm::dvec3(0, 0, -1), {1, 0, -1}, {0, 1, -1}};
    const auto moved = [&](double x, double y) {
        Corners all = corners;
        for (glm::dvec3& corner : all) corner += glm::dvec3(x, y, 0.0);
        return all;
    };
    const glm::dvec3 down(0, 0, -2);
    CHECK(crossing_of(down, moved(-0.2, -0.3)) == Crossing::from_back);
    const Corners turned{corners[0], corners[2], corners[1]};
    CHECK(crossing_of(down + glm::dvec3(0.2, 0.2, 0), turned) == Crossing::from_front);
    CHECK(crossing_of(down, moved(-0.8, -0.3)) == Crossing::none);
    CHECK(crossing_of(0.4 * down, moved(-0.2, -0.3)) == Crossing::none);
    CHECK(crossing_of(down, moved(-0.2, 0.0)) == Crossing::unknown);
    CHECK(crossing_of(0.5 * down, moved(-0.2, -0.3)) == Crossing::unknown);
}

TEST_CASE("distances of segments and triangles are those of their nearest points") {
    CHECK(distance_between({2, 0, 0}, {1, 3, -1}, {1, 3, 1}) == doctest::Approx(3.0));
    CHECK(distance_between({2, 0, 0}, {3, 1, 0}, {4, 1, 0}) == doctest::Approx(std::sqrt(2.0)));
    CHECK(distance_between({2, 0, 0}, {1, 0, -1}, {1, 0, 1}) == doctest::Approx(0.0));
    const Corners corners{glm::dvec3(0, 0, 0), {2, 0, 0}, {0, 2, 0}};
    CHECK(distance_to_triangle({0.5, 0.5, -3}, corners) == doctest::Approx(3.0));
    CHECK(distance_to_triangle({-1, 1, 0}, corners) == doctest::Approx(1.0));
    CHECK(distance_to_triangle({3, 0, 0}, corners) == doctest::Approx(1.0));
}

TEST_CASE("the winding number of closed shapes is that of their insides") {
    const auto winding = [](const MeshSource& source, const glm::dvec3& point) {
        const Mesh mesh(source);
        return winding_number(FaceTree(mesh), mesh, point, 1e-6);
    };
    const MeshSource torus = make_built_in_shape("torus", 2000);
    Random random(4);
    const Mesh mesh(torus);
    const FaceTree tree(mesh);
    // The circle in the middle of its tube: its radius from the bounds.
    const double tube = 0.5 * (mesh.bounds().high.y - mesh.bounds().low.y);
    const double circle = mesh.bounds().high.x - tube;
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 p = 1.5 * glm::dvec3(random.in_cube()) * glm::dvec3(1, 0.4, 1);
        const double away = std::hypot(std::hypot(p.x, p.z) - circle, p.y);
        if (std::abs(away - tube) < 0.05 * tube) continue;
        CHECK(winding_number(tree, mesh, p, 1e-6) == (away < tube ? 1 : 0));
        inside += away < tube ? 1 : 0;
    }
    CHECK(inside > 30);
    const MeshSource box = make_built_in_shape("box", 12);
    CHECK(winding(box, {0.3, 0.2, -0.1}) == 1);
    CHECK(winding(box, {0.0, 0.0, 0.0}) == 1);
    CHECK(winding(turned_inside_out(box), {0.3, 0.2, -0.1}) == -1);
    MeshSource twice = box;
    twice.triangles.insert(twice.triangles.end(), box.triangles.begin(), box.triangles.end());
    CHECK(winding(twice, {0.3, 0.2, -0.1}) == 2);
    // On the surface, and next to it.
    CHECK_FALSE(winding(box, {1.0, 0.2, -0.1}));
    CHECK_FALSE(winding(box, {1.0 + 1e-7, 0.2, -0.1}));
    CHECK(winding(box, {1.0 + 1e-4, 0.2, -0.1}) == 0);
}

TEST_CASE("winding numbers are those of exact arithmetic") {
    constexpr std::uint64_t k_seed = 8;
    CAPTURE(k_seed);
    Random random(k_seed);
    int known = 0;
    for (const MeshSource& source :
         {make_built_in_shape("knot", 500), figure_eight(16, 8), boxes_on_an_edge()}) {
        const Mesh mesh(source);
        const FaceTree tree(mesh);
        const glm::dvec3 outside = mesh.center() + mesh.radius() * glm::dvec3(2.13, 3.31, -4.57);
        for (int i = 0; i < 60; ++i) {
            const glm::dvec3 p = mesh.center() + 0.7 * mesh.radius() * glm::dvec3(random.in_cube());
            const std::optional<int> winding = winding_number(tree, mesh, p, 1e-9);
            if (!winding) continue;
            int exact = 0;
            for (const Triangle& t : mesh.triangles()) {
                SpaceTriangle corners;
                for (std::size_t c = 0; c < 3; ++c)
                    corners[c] = {whole(mesh.positions()[index(t[c])]), false};
                const std::optional<int> crossed =
                    crossing({whole(p), false}, {whole(outside), false}, corners);
                REQUIRE(crossed);
                exact -= *crossed;
            }
            CHECK(*winding == exact);
            ++known;
        }
    }
    CHECK(known > 150);
}

}  // namespace
}  // namespace rimline
