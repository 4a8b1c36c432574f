#include "silhouette/methods/literal/literal_forest.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <type_traits>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/methods/literal/literal_octree.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/methods/literal/literal_extraction.h"

namespace rimline {
namespace {

constexpr LiteralListing k_listings[] = {LiteralListing::sfo_from_any,
                                         LiteralListing::sfo_from_all};
constexpr LiteralForestOptions k_complete[] = {
    {LiteralCulling::points_and_edges, LiteralListing::sfo_from_any, {}},
    {LiteralCulling::straddling, LiteralListing::sfo_from_any, {}},
    {LiteralCulling::straddling, LiteralListing::sfo_from_all, {}}};
constexpr LiteralForestOptions k_to_the_letter{
    LiteralCulling::points_and_edges, LiteralListing::sfo_from_all, {}};

static_assert(!std::is_constructible_v<LiteralForest, Mesh, std::span<const glm::dvec3>,
                                       std::span<const std::uint32_t>, LiteralForestOptions>);

// A mesh with two origins, each face with the origin that HoughOctree gives it.
struct TwoOrigins {
    Mesh mesh{make_built_in_shape("knot", 3000)};
    std::vector<glm::dvec3> origins{{0.0, 0.0, 0.0}, {1.5, 0.75, -0.5}};  // Floats.
    std::vector<std::uint32_t> groups = HoughOctree(mesh, {origins}).face_groups();

    LiteralForest forest(const LiteralForestOptions& options) const {
        return LiteralForest(mesh, origins, groups, options);
    }
    // Whether an edge is SFO from the origin of its face `from`, by the definition.
    bool is_sfo(const Edge& edge, std::size_t from) const {
        const glm::dvec3& o = origins[groups[index(edge.faces[from])]];
        const HomogeneousPoint point = HomogeneousPoint::viewpoint(glm::vec3(o));
        return is_front(mesh.plane(edge.faces[0]), point) !=
               is_front(mesh.plane(edge.faces[1]), point);
    }
};

TEST_CASE("with several origins every complete literal extraction equals brute force" *
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
            for (LiteralForestOptions options : k_complete) {
                CAPTURE(int(options.culling));
                CAPTURE(int(options.listing));
                CHECK(options.is_complete());
                for (const std::uint32_t bucket : {1u, 7u}) {
                    options.octree.bucket_size = bucket;
                    tests::check_literal_extraction(
                        mesh,
                        LiteralForest(mesh, std::span(origins).first(count), grouped.face_groups(),
                                      options),
                        100, 100 * count + bucket);
                }
            }
        }
    }
}

TEST_CASE("faces may belong to any origin") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const std::vector<glm::dvec3> origins = {mesh.center(), {2.0, 0.3, -0.4}, {0.0, 0.7, 0.1}};
    std::vector<std::uint32_t> groups(mesh.face_count());
    for (std::uint32_t f = 0; f < groups.size(); ++f) groups[f] = f * 2654435761u % 3;
    for (const LiteralForestOptions& options : k_complete)
        tests::check_literal_extraction(mesh, LiteralForest(mesh, origins, groups, options), 200,
                                        5);
}

TEST_CASE("edges are listed that are SFO from any of their origins or from all") {
    const TwoOrigins two;
    std::uint32_t from_any = 0;
    std::uint32_t from_all = 0;
    for (std::uint32_t e = 0; e < two.mesh.edge_count(); ++e) {
        const Edge& edge = two.mesh.edge(EdgeId{e});
        from_any += two.is_sfo(edge, 0) || two.is_sfo(edge, 1);
        from_all += two.is_sfo(edge, 0) && two.is_sfo(edge, 1);
    }
    CHECK(from_all > 0);
    CHECK(from_any > from_all);
    const auto listed = [&](LiteralCulling culling, LiteralListing listing) {
        return two.forest({culling, listing, {}}).statistics().listed_edges;
    };
    for (const LiteralCulling culling :
         {LiteralCulling::points_and_edges, LiteralCulling::straddling})
        CHECK(listed(culling, LiteralListing::sfo_from_all) == from_all);
    CHECK(listed(LiteralCulling::straddling, LiteralListing::sfo_from_any) == from_any);
    // This also lists edges with a face on different sides of the two origins.
    CHECK(listed(LiteralCulling::points_and_edges, LiteralListing::sfo_from_any) >= from_any);
}

TEST_CASE("the text of 4.4.5 to the letter loses edges and finds others twice") {
    CHECK(!k_to_the_letter.is_complete());
    const TwoOrigins two;
    const LiteralForest forest = two.forest(k_to_the_letter);
    const Orbit orbit(two.mesh.center(), {0.0, 1.0, 0.0}, 2.0 * two.mesh.radius());
    std::size_t lost = 0;
    for (double angle = 0.0; angle < 6.0; angle += 0.5) {
        const HomogeneousPoint point = orbit.viewpoint(angle);
        const std::vector<EdgeId> truth = brute_force_silhouette(two.mesh, point);
        std::vector<EdgeId> edges;
        LiteralCounters counters;
        forest.extract(point, edges, counters);
        std::ranges::sort(edges);
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        // What it finds is on the silhouette.
        CHECK(std::ranges::includes(truth, edges));
        lost += truth.size() - edges.size();
    }
    CHECK(lost > 0);
}

TEST_CASE("with one origin both lists are the same") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const std::vector<glm::dvec3> origins = {mesh.center()};
    const std::vector<std::uint32_t> groups(mesh.face_count(), 0);
    std::vector<std::uint32_t> listed;
    for (const LiteralListing listing : k_listings) {
        const LiteralForest forest(mesh, origins, groups,
                                   {LiteralCulling::points_and_edges, listing, {}});
        listed.push_back(forest.statistics().listed_edges);
        tests::check_literal_extraction(mesh, forest, 100, 7);
    }
    CHECK(listed[0] == listed[1]);
}

TEST_CASE("with one origin a forest counts what the literal octree counts") {
    for (const char* shape : {"knot", "terrain", "torus"}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, 2000));
        const LiteralOctree octree(mesh);
        const std::vector<glm::dvec3> origins = {octree.origin()};
        const std::vector<std::uint32_t> groups(mesh.face_count(), 0);
        const LiteralForest forest(mesh, origins, groups);
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
