#include "silhouette/methods/edge_leaves.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline {
namespace {

TEST_CASE("sixteen planes have their own faces' bits, with every instruction set") {
    const std::vector<KernelPointer<FrontOfSixteen>> versions = all_versions<FrontOfSixteen>();
    MESSAGE("versions tested: ", versions.size());
    const Mesh mesh(tests::triangle_soup(2000, 3));
    tests::ProbePoints probes(mesh, 101);
    for (std::uint32_t i = 0; i < 200; ++i) {
        const HomogeneousPoint p = probes.next();
        const std::uint32_t first = probes.random_below(mesh.face_count() - k_leaf_items);
        SixteenPlanes planes;
        std::uint32_t expected = 0;
        // The last lane is not set: it has no normal.
        for (std::uint32_t lane = 0; lane + 1 < k_leaf_items; ++lane) {
            const Plane& plane = mesh.plane(FaceId{first + lane});
            planes.set(lane, plane);
            if (is_front(plane, p)) expected |= 1u << lane;
        }
        for (const auto& front : versions) CHECK(front(planes, p) == expected);
    }
}

TEST_CASE("leaves and the rest together have every edge but borders, each once") {
    const std::uint64_t seed = 102;
    CAPTURE(seed);
    for (const auto& [name, source] : tests::made_meshes(500)) {
        CAPTURE(name);
        const Mesh mesh(source);
        // Leaves may have any regular edges in any order.
        std::vector<EdgeId> treed;
        for (std::uint32_t e = 0; e < mesh.edges_of_class(EdgeClass::regular).last; ++e)
            if (e % 7 != 3) treed.push_back(EdgeId{e});
        std::mt19937_64 random(seed);
        std::shuffle(treed.begin(), treed.end(), random);
        const EdgeLeaves leaves(mesh, treed);
        const std::uint32_t all = mesh.edges_of_class(EdgeClass::border).first;
        CHECK(leaves.rest_count() == all - treed.size());
        tests::ProbePoints probes(mesh, seed);
        for (std::uint32_t i = 0; i < 20; ++i) {
            const HomogeneousPoint p = probes.next();
            std::vector<EdgeId> edges;
            TraversalCounters counters;
            for (std::uint32_t leaf = 0; leaf * k_leaf_items < treed.size(); ++leaf)
                leaves.test_leaf(leaf, p, edges, counters);
            leaves.test_rest(p, edges, counters);
            std::sort(edges.begin(), edges.end());
            REQUIRE(edges == brute_force_silhouette(mesh, p));
            REQUIRE(counters.edge_checks == all);
        }
    }
}

}  // namespace
}  // namespace rimline
