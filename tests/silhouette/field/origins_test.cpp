#include "silhouette/field/origins.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

TEST_CASE("viewpoints around a model beyond the coordinates are an error") {
    MeshSource source = make_built_in_shape("box");
    for (glm::vec3& p : source.positions) p *= 0x1p59f;
    CHECK_THROWS_AS(spread_viewpoints(Mesh(source), 8), Error);
    for (glm::vec3& p : source.positions) p *= 0.25f;
    CHECK(spread_viewpoints(Mesh(source), 8).size() == 8);
}

TEST_CASE("origins lie within three radii and are the same for any number of threads") {
    const Mesh mesh(make_built_in_shape("knot", 4000));
    OriginSet alone;
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        alone = find_origins(mesh, 4);
    }
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    const OriginSet together = find_origins(mesh, 4);
    REQUIRE(alone.origins.size() == 4);
    CHECK(alone.origins == together.origins);
    CHECK(alone.votes == together.votes);
    for (const glm::dvec3& origin : alone.origins)
        CHECK(glm::distance(origin, mesh.center()) <= 3.0 * mesh.radius() * (1.0 + 1e-12));
    for (std::size_t i = 1; i < 4; ++i) CHECK(alone.votes[i] <= alone.votes[i - 1]);
    const OriginSet two = find_origins(mesh, 2);
    CHECK(two.origins[1] == alone.origins[1]);
}

TEST_CASE("origins follow a mesh that is scaled by a power of two") {
    const MeshSource source = make_built_in_shape("spring", 2000);
    const OriginSet found = find_origins(Mesh(source), 3);
    for (const float scale : {0x1p-60f, 0x1p40f}) {
        MeshSource scaled = source;
        for (glm::vec3& p : scaled.positions) p *= scale;
        const OriginSet other = find_origins(Mesh(scaled), 3);
        REQUIRE(other.origins.size() == found.origins.size());
        for (std::size_t i = 0; i < found.origins.size(); ++i)
            CHECK(other.origins[i] == found.origins[i] * double{scale});
    }
}

TEST_CASE("a trial counts the work of the extractions it stands for") {
    const Mesh mesh(make_built_in_shape("torus", 3000));
    const OriginSet found = find_origins(mesh, 2);
    const OriginTrial trial = try_origins(mesh, found.origins, 100);
    const HoughOctree octree(mesh, {found.origins});
    TraversalCounters sum;
    std::vector<EdgeId> edges;
    for (const HomogeneousPoint& point : spread_viewpoints(mesh, 100))
        octree.extract(point, edges, sum);
    CHECK(trial.mean.box_checks == sum.box_checks / 100);
    CHECK(trial.mean.edge_checks == sum.edge_checks / 100);
    CHECK(trial.work ==
          doctest::Approx((double(sum.box_checks) + 2.0 * double(sum.edge_checks)) / 100));
    CHECK(trial.statistics.group_faces.size() == 2);
}

TEST_CASE("the chosen number of origins has the least work of all that were tried") {
    const Mesh mesh(make_built_in_shape("scene", 3000));
    const ChosenOrigins chosen = choose_origins(mesh, 3, 60);
    REQUIRE(chosen.trials.size() == chosen.found.origins.size() + 1);
    for (std::size_t i = 0; i < chosen.trials.size(); ++i) {
        CHECK(chosen.trials[i].count == i);
        CHECK(chosen.trials[i].work >= chosen.trials[chosen.best].work);
    }
}

TEST_CASE("origins of meshes that have little to choose from are defined") {
    const Mesh none{MeshSource{}};
    CHECK(find_origins(none, 3).origins.size() == 1);
    CHECK(choose_origins(none, 3, 10).trials.size() == 2);

    const Mesh one(MeshSource{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}});
    const OriginSet found = find_origins(one, 3);
    REQUIRE(found.origins.size() == 1);
    CHECK(found.votes[0] == doctest::Approx(1.0));
    CHECK(try_origins(one, found.origins, 10).statistics.group_faces[0] == 1);

    MeshSource flat;  // All coplanar, in both orientations.
    for (int i = 0; i < 4; ++i) {
        flat.positions.insert(flat.positions.end(), {{i, 0, 0}, {i + 1, 0, 0}, {i, 1, 0}});
        const auto v = static_cast<std::uint32_t>(3 * i);
        if (i % 2 == 0)
            flat.triangles.push_back({v, v + 1, v + 2});
        else
            flat.triangles.push_back({v, v + 2, v + 1});
    }
    for (const glm::dvec3& origin : find_origins(Mesh(flat), 3).origins)
        CHECK(std::isfinite(origin.x + origin.y + origin.z));
    CHECK(choose_origins(Mesh(tests::book(5)), 2, 10).trials.size() >= 2);
}

TEST_CASE("coordinates too large for points around the mesh are refused") {
    MeshSource source = tests::octahedron();
    for (glm::vec3& p : source.positions) p *= 0x1p60f;
    CHECK_THROWS_AS(find_origins(Mesh(source), 2), Error);
}

}  // namespace
}  // namespace rimline
