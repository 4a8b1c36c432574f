#include "tools/bench/box_tests.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using tools::BoxTest;
using tools::count_boxes;
using tools::k_box_tests;
using tools::side_of;

namespace {

HoughBox box_of(const glm::dvec3& low, const glm::dvec3& high) {
    HoughBox box;
    box.include(HoughPoint{low, 0.0, 1});
    box.include(HoughPoint{high, 0.0, 1});
    return box;
}

}  // namespace

TEST_CASE("what a box test says of a box is true of all its points") {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> along(-1.0, 1.0);
    const auto random = [&] { return glm::dvec3(along(engine), along(engine), along(engine)); };
    std::size_t decided[k_box_tests.size()] = {};
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 q = 2.0 * random();
        const glm::dvec3 size = 0.2 * (random() + 1.0);
        const glm::dvec3 low = random();
        const HoughBox box = box_of(low, low + size);
        const VSphereSide exact = side_of(box, q, BoxTest::exact);
        for (std::size_t t = 0; t < k_box_tests.size(); ++t) {
            CAPTURE(std::string(name_of(k_box_tests[t])));
            const VSphereSide side = side_of(box, q, k_box_tests[t]);
            if (side == VSphereSide::mixed) continue;
            ++decided[t];
            CHECK(side == exact);
            for (int k = 0; k < 20; ++k) {
                const glm::dvec3 h = low + size * (0.5 * (random() + 1.0));
                CHECK((glm::dot(h, h - q) < 0.0) == (side == VSphereSide::inside));
            }
        }
    }
    for (std::size_t t = 1; t < k_box_tests.size(); ++t) {
        CAPTURE(std::string(name_of(k_box_tests[t])));
        CHECK(decided[t] > 0);
        CHECK(decided[t] < decided[0]);
    }
}

TEST_CASE("a box beside a v-sphere is told from it by some tests alone") {
    const glm::dvec3 q(2.0, 0.0, 0.0);  // Center (1, 0, 0), radius 1.
    // Beyond the sphere's box; in its corner; across the sphere; in its middle; a rod inside.
    const HoughBox beyond = box_of({2.5, 0.0, 0.0}, {2.6, 0.1, 0.1});
    const HoughBox corner = box_of({1.8, 0.8, 0.8}, {1.9, 0.9, 0.9});
    const HoughBox across = box_of({1.5, 0.0, 0.0}, {2.5, 0.1, 0.1});
    const HoughBox middle = box_of({0.9, -0.1, -0.1}, {1.1, 0.1, 0.1});
    const HoughBox rod = box_of({0.5, 0.6, -0.05}, {1.5, 0.75, 0.05});
    using enum VSphereSide;
    for (const BoxTest test : k_box_tests) {
        CAPTURE(std::string(name_of(test)));
        CHECK(side_of(beyond, q, test) == outside);
        CHECK(side_of(across, q, test) == mixed);
        CHECK(side_of(middle, q, test) == inside);
        CHECK(side_of(corner, q, test) == (test == BoxTest::sphere_box ? mixed : outside));
        const bool by_sphere = test == BoxTest::spheres || test == BoxTest::inside_sphere;
        CHECK((side_of(rod, q, test) == mixed) == (by_sphere || test == BoxTest::intervals));
    }
}

TEST_CASE("exact box tests count what the literal octree counts and looser ones more") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const LiteralOctree octree(mesh);
    const Orbit orbit(mesh.center(), {0.0, 1.0, 0.0}, 2.0 * mesh.radius());
    for (double angle = 0.0; angle < 6.0; angle += 1.0) {
        const HomogeneousPoint point = orbit.viewpoint(angle);
        std::vector<EdgeId> edges;
        LiteralCounters expected;
        octree.extract(point, edges, expected);
        const LiteralCounters exact = count_boxes(octree, point, BoxTest::exact);
        CHECK(exact.pbv_checks == expected.pbv_checks);
        CHECK(exact.ebv_checks == expected.ebv_checks);
        for (std::size_t t = 1; t < k_box_tests.size(); ++t)
            CHECK(count_boxes(octree, point, k_box_tests[t]).box_checks() > exact.box_checks());
        const LiteralCounters swapped = count_boxes(octree, point, BoxTest::exact, true);
        CHECK(swapped.ebv_checks == exact.pbv_checks);
        CHECK(swapped.pbv_checks != exact.ebv_checks);
    }
}
