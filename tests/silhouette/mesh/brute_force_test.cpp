#include "silhouette/mesh/brute_force.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

std::uint32_t front_count(const Mesh& mesh, const HomogeneousPoint& point) {
    const auto words = brute_force_face_bits(mesh, point);
    std::uint32_t count = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) count += face_bit(words, FaceId{f});
    return count;
}

}  // namespace

TEST_CASE("an empty mesh has no silhouette") {
    const Mesh mesh{MeshSource{}};
    const auto point = HomogeneousPoint::viewpoint({1, 2, 3});
    CHECK(brute_force_face_bits(mesh, point).empty());
    CHECK(brute_force_silhouette(mesh, point).empty());
}

TEST_CASE("a lone triangle has borders and no silhouette") {
    const Mesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    CHECK(front_count(mesh, HomogeneousPoint::viewpoint({0, 0, 1})) == 1);
    CHECK(front_count(mesh, HomogeneousPoint::viewpoint({9, 9, 0})) == 0);
    CHECK(brute_force_silhouette(mesh, HomogeneousPoint::viewpoint({0, 0, 1})).empty());
}

TEST_CASE("a box shows one, two or three sides, bounded by four or six edges") {
    using P = HomogeneousPoint;
    struct Region {
        P point;
        std::uint32_t sides, edges;
    };
    const Region regions[] = {
        {P::viewpoint({3, 4, 5}), 3, 6},  {P::viewpoint({-3, 4, -5}), 3, 6},
        {P::viewpoint({3, 3, 0}), 2, 6},  {P::viewpoint({0.5f, -3, 7}), 2, 6},
        {P::viewpoint({0, 0, 3}), 1, 4},  {P::viewpoint({0.9f, -0.9f, -3}), 1, 4},
        {P::viewpoint({0, 0, 0}), 0, 0},  {P::viewpoint({0.9f, 0.9f, 0.9f}), 0, 0},
        {P::viewpoint({1, 0, 0}), 0, 0},  // On a side.
        {P::viewpoint({1, 1, 1}), 0, 0},  // On a corner.
        {P::viewpoint({1, 5, 0}), 1, 4},  // On a side's plane, outside: that side is back.
        {P::viewpoint({1, 5, 1}), 1, 4},  {P::viewpoint({0x1p60f, 0, 0}), 1, 4},
        {P::direction({1, 1, 1}), 3, 6},  {P::direction({1, -1, 0}), 2, 6},
        {P::direction({0, 0, -1}), 1, 4}, {P::direction({0, 0, 0}), 0, 0},
    };
    for (const std::uint32_t n : {1u, 2u, 7u}) {
        const Mesh mesh(make_built_in_shape("box", 12 * n * n));
        REQUIRE(mesh.face_count() == 12 * n * n);
        for (const auto& [point, sides, edges] : regions) {
            CAPTURE(n);
            CAPTURE(point.x);
            CAPTURE(point.y);
            CAPTURE(point.z);
            CAPTURE(point.w);
            CHECK(front_count(mesh, point) == sides * 2 * n * n);
            CHECK(brute_force_silhouette(mesh, point).size() == edges * n);
        }
    }
}

TEST_CASE("a sphere shows the cap that a cone from the viewpoint touches") {
    const Mesh mesh(make_built_in_shape("sphere", 20'000));
    tests::Random random(1);
    for (const float distance : {1.2f, 2.0f, 10.0f}) {
        const glm::vec3 p = distance * glm::normalize(random.in_cube());
        CAPTURE(distance);
        const double share = 0.5 * (1.0 - 1.0 / distance);
        const auto point = HomogeneousPoint::viewpoint(p);
        CHECK(front_count(mesh, point) / double(mesh.face_count()) ==
              doctest::Approx(share).epsilon(0.05));
        const auto silhouette = brute_force_silhouette(mesh, point);
        CHECK(silhouette.size() > 100);
        // The plane x * p = 1, within a face's size.
        for (const EdgeId e : silhouette)
            for (const VertexId v : mesh.edge(e).vertices)
                CHECK(std::abs(glm::dot(mesh.positions()[index(v)], p) - 1.0f) < 0.05f * distance);
    }
}

TEST_CASE("the silhouette of a closed mesh is made of closed loops") {
    tests::Random random(2);
    for (const std::string_view name : {"sphere", "torus", "knot", "box", "spring", "scene"}) {
        const Mesh mesh(make_built_in_shape(name, 3000));
        for (int i = 0; i < 40; ++i) {
            CAPTURE(name);
            CAPTURE(i);
            const glm::vec3 p = 3.0f * random.in_cube();
            const auto point = i % 3 == 0 ? HomogeneousPoint::direction(p)
                               : i % 3 == 1
                                   ? HomogeneousPoint::viewpoint(p)
                                   : HomogeneousPoint::viewpoint(
                                         mesh.positions()[random.below(mesh.vertex_count())]);
            std::vector<std::uint32_t> degree(mesh.vertex_count());
            const auto silhouette = brute_force_silhouette(mesh, point);
            CHECK(std::is_sorted(silhouette.begin(), silhouette.end()));
            for (const EdgeId e : silhouette)
                for (const VertexId v : mesh.edge(e).vertices) ++degree[index(v)];
            CHECK(std::all_of(degree.begin(), degree.end(), [](auto d) { return d % 2 == 0; }));
        }
    }
}

TEST_CASE("opposite directions see the same silhouette") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    tests::Random random(3);
    for (int i = 0; i < 20; ++i) {
        CAPTURE(i);
        const glm::vec3 v = random.in_cube();
        CHECK(brute_force_silhouette(mesh, HomogeneousPoint::direction(v)) ==
              brute_force_silhouette(mesh, HomogeneousPoint::direction(-v)));
    }
}

TEST_CASE("turning every face over keeps the silhouette where no plane holds the viewpoint") {
    MeshSource source = make_built_in_shape("torus", 1000);
    const Mesh mesh(source);
    for (auto& t : source.triangles) std::swap(t[1], t[2]);
    const Mesh turned(source);
    REQUIRE(turned.is_oriented());
    const auto point = HomogeneousPoint::viewpoint({2.1f, 1.3f, -0.7f});
    CHECK(brute_force_silhouette(mesh, point) == brute_force_silhouette(turned, point));
    CHECK(front_count(mesh, point) + front_count(turned, point) == mesh.face_count());
}

}  // namespace rimline
