#include "silhouette/methods/literal/literal_forest.h"

#include <doctest/doctest.h>

#include <type_traits>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/methods/literal/literal_octree.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/methods/literal/literal_extraction.h"

namespace rimline {
namespace {

constexpr LiteralCulling k_cullings[] = {LiteralCulling::points_and_edges,
                                         LiteralCulling::straddling};

static_assert(!std::is_constructible_v<LiteralForest, Mesh, std::span<const glm::dvec3>,
                                       std::span<const std::uint32_t>, LiteralCulling>);

TEST_CASE("with several origins the literal extraction equals brute force by either culling" *
          doctest::test_suite("plain")) {
    for (const auto& [name, source] : tests::made_meshes(1200)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const double r = mesh.radius();
        const glm::dvec3 c = mesh.center();
        // Near, far, in planes of faces, and twice the same.
        const std::vector<glm::dvec3> origins = {
            c, c + glm::dvec3(0.9 * r, 0.1 * r, 0.0), c + glm::dvec3(-2.0 * r, r, r), c,
            mesh.vertex_count() > 0 ? glm::dvec3(mesh.positions()[0]) : c};
        for (std::size_t count = 1; count <= origins.size(); ++count) {
            CAPTURE(count);
            const HoughOctree grouped(mesh, {{origins.begin(), origins.begin() + count}});
            for (const LiteralCulling culling : k_cullings) {
                CAPTURE(int(culling));
                for (const std::uint32_t bucket : {1u, 7u})
                    tests::check_literal_extraction(
                        mesh,
                        LiteralForest(mesh, std::span(origins).first(count), grouped.face_groups(),
                                      culling, {.bucket_size = bucket}),
                        100, 100 * count + bucket);
            }
        }
    }
}

TEST_CASE("faces may belong to any origin") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const std::vector<glm::dvec3> origins = {mesh.center(), {2.0, 0.3, -0.4}, {0.0, 0.7, 0.1}};
    std::vector<std::uint32_t> groups(mesh.face_count());
    for (std::uint32_t f = 0; f < groups.size(); ++f) groups[f] = f * 2654435761u % 3;
    for (const LiteralCulling culling : k_cullings)
        tests::check_literal_extraction(mesh, LiteralForest(mesh, origins, groups, culling), 200,
                                        5);
}

TEST_CASE("with one origin a forest counts what the literal octree counts") {
    for (const char* shape : {"knot", "terrain", "torus"}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, 2000));
        const LiteralOctree octree(mesh);
        const std::vector<glm::dvec3> origins = {octree.origin()};
        const std::vector<std::uint32_t> groups(mesh.face_count(), 0);
        const LiteralForest forest(mesh, origins, groups, LiteralCulling::points_and_edges);
        CHECK(forest.statistics().tree_edges == octree.statistics().tree_edges);
        CHECK(forest.statistics().listed_edges == octree.statistics().sfo_edges +
                                                      octree.statistics().undecided_edges +
                                                      octree.statistics().nonmanifold_edges);
        const Orbit orbit(mesh.center(), {0.0, 1.0, 0.0}, 2.0 * mesh.radius());
        for (double angle = 0.0; angle < 6.0; angle += 1.0) {
            std::vector<EdgeId> edges;
            LiteralCounters expected;
            octree.extract(orbit.viewpoint(angle), edges, expected);
            LiteralCounters counted;
            forest.extract(orbit.viewpoint(angle), edges, counted);
            CHECK(counted.pbv_checks == expected.pbv_checks);
            CHECK(counted.ebv_checks == expected.ebv_checks);
            CHECK(counted.face_checks == expected.face_checks);
            CHECK(counted.edge_tests == expected.edge_tests);
        }
    }
}

}  // namespace
}  // namespace rimline
