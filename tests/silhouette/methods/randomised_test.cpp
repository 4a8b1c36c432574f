#include "silhouette/methods/randomised.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/probe_points.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline {
namespace {

enum class Step : std::uint8_t { extract, update };

std::vector<EdgeId> found_by(Randomised& method, Step step, const HomogeneousPoint& point) {
    std::vector<EdgeId> edges{k_no_edge};  // extract() must replace it.
    TraversalCounters counters;
    if (step == Step::extract)
        method.extract(point, edges, counters);
    else
        method.update(point, edges, counters);
    CHECK(counters.edge_checks >= edges.size());
    std::sort(edges.begin(), edges.end());
    return edges;
}

TEST_CASE("what a random search finds is on the silhouette, each edge once") {
    const std::uint64_t seed = 91;
    CAPTURE(seed);
    for (const auto& [name, source] : tests::made_meshes(1000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        Randomised method(mesh, seed);
        tests::RandomWalk walk(mesh, seed);
        for (std::uint32_t i = 0; i < 100; ++i) {
            const HomogeneousPoint p = walk.next();
            const std::vector<EdgeId> found =
                found_by(method, i % 4 == 0 ? Step::extract : Step::update, p);
            const std::vector<EdgeId> all = brute_force_silhouette(mesh, p);
            REQUIRE(std::adjacent_find(found.begin(), found.end()) == found.end());
            REQUIRE(std::includes(all.begin(), all.end(), found.begin(), found.end()));
        }
    }
}

// The share of all silhouettes' edges that the method finds, over viewpoints around a shape.
double recall(const Mesh& mesh, Step step) {
    Randomised method(mesh, 5);
    std::size_t found = 0;
    std::size_t all = 0;
    for (std::uint32_t i = 0; i < 200; ++i) {
        const double angle_rad = 0.02 * i;
        const HomogeneousPoint p = HomogeneousPoint::viewpoint(glm::vec3(
            mesh.center() +
            3.0 * mesh.radius() * glm::dvec3(std::cos(angle_rad), 0.4, std::sin(angle_rad))));
        found += found_by(method, step, p).size();
        all += brute_force_silhouette(mesh, p).size();
    }
    REQUIRE(all > 0);
    return static_cast<double>(found) / static_cast<double>(all);
}

TEST_CASE("on smooth closed shapes a random search finds nearly all of the silhouette") {
    for (const std::string_view shape : {"sphere", "torus", "knot"}) {
        CAPTURE(std::string(shape));
        const Mesh mesh(make_built_in_shape(shape, 20000));
        REQUIRE(mesh.is_closed());
        CHECK(recall(mesh, Step::extract) > 0.98);
        CHECK(recall(mesh, Step::update) > 0.98);
    }
}

TEST_CASE("a random search looks at a small part of a large mesh") {
    const Mesh mesh(make_built_in_shape("torus", 100000));
    Randomised method(mesh, 1);
    std::vector<EdgeId> edges;
    TraversalCounters counters;
    method.extract(HomogeneousPoint::viewpoint({2.0f, 1.5f, 0.7f}), edges, counters);
    CHECK(edges.size() > 100);
    CHECK(counters.edge_checks < mesh.edge_count() / 10);
}

TEST_CASE("a random search is the same for the same seed and another for another") {
    // Small parts that seeds often miss.
    MeshSource source;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const glm::dvec3 offset(4.0 * (i % 20), 4.0 * (i / 20), 0.0);
        source = tests::joined(
            source, tests::placed(tests::box(glm::vec3(-1.0f), glm::vec3(1.0f)), 1.0, offset));
    }
    const Mesh mesh(source);
    const HomogeneousPoint p = HomogeneousPoint::viewpoint({-30.0f, 20.0f, 100.0f});
    Randomised a(mesh, 1);
    Randomised b(mesh, 1);
    Randomised other(mesh, 2);
    const std::vector<EdgeId> found = found_by(a, Step::extract, p);
    CHECK(found.size() > 100);
    CHECK(found.size() < brute_force_silhouette(mesh, p).size());  // The method is not exact.
    CHECK(found_by(b, Step::extract, p) == found);
    CHECK(found_by(other, Step::extract, p) != found);
    // Updates continue with the stored state; extract() starts anew.
    CHECK(found_by(a, Step::update, p).size() >= found.size());
    CHECK(found_by(a, Step::extract, p) == found);
}

TEST_CASE("a random search reports how many random edges it tried") {
    const Mesh mesh(make_built_in_shape("sphere", 5000));
    Randomised method(mesh, 1);
    found_by(method, Step::extract, HomogeneousPoint::viewpoint({3.0f, 0.0f, 0.0f}));
    const std::vector<NamedCount> counts = method.own_counts();
    REQUIRE(counts.size() == 2);
    CHECK(counts[0].name == "random_edges");
    CHECK(counts[0].count > 0);
    CHECK(counts[1].name == "random_hits");
    CHECK(counts[1].count > 0);
    CHECK(counts[1].count < counts[0].count);
}

}  // namespace
}  // namespace rimline
