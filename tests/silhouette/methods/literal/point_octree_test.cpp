#include "silhouette/methods/literal/point_octree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/silhouette/methods/literal/octants.h"

namespace rimline {
namespace {

TEST_CASE("no points make no nodes, and one point makes a leaf") {
    CHECK(build_point_octree({}).nodes.empty());
    CHECK(leaf_depth_histogram({}).empty());
    const std::vector<glm::dvec3> one{{1.0, 2.0, 3.0}};
    const PointOctree octree = build_point_octree(one);
    REQUIRE(octree.nodes.size() == 1);
    CHECK(octree.nodes[0].is_leaf());
    CHECK(octree.root.low == one[0]);
    CHECK(octree.root.high == one[0]);
    CHECK(leaf_depth_histogram(octree.nodes) == std::vector<std::uint32_t>{1});
}

TEST_CASE("every point lies in the octants of its leaf and of all above") {
    const std::vector<glm::dvec3> points = tests::clustered_points(3000, 1);
    for (const std::uint32_t bucket_size : {1u, 7u}) {
        const PointOctree octree = build_point_octree(points, {bucket_size});
        const std::vector<Octant> octants = tests::octants_of(octree.nodes, octree.root);
        for (std::size_t i = 0; i < octree.nodes.size(); ++i) {
            const OctreeNode& node = octree.nodes[i];
            REQUIRE(node.begin < node.end);
            bool all_equal = true;
            for (std::uint32_t k = node.begin; k < node.end; ++k) {
                REQUIRE(tests::holds(octants[i], points[octree.order[k]]));
                all_equal &= points[octree.order[k]] == points[octree.order[node.begin]];
            }
            // Divided exactly when it must be.
            CHECK(node.is_leaf() == (node.size() <= bucket_size || all_equal));
            std::uint32_t next = node.begin;
            std::uint32_t children = 0;
            for (const std::uint32_t child : node.children) {
                if (child == k_no_node) continue;
                CHECK(child > i);
                CHECK(octree.nodes[child].depth == node.depth + 1);
                CHECK(octree.nodes[child].begin == next);
                next = octree.nodes[child].end;
                ++children;
            }
            CHECK(children == node.child_count);
            if (!node.is_leaf()) CHECK(next == node.end);
        }
        std::vector<std::uint32_t> order = octree.order;
        std::sort(order.begin(), order.end());
        std::vector<std::uint32_t> all(points.size());
        std::iota(all.begin(), all.end(), 0u);
        CHECK(order == all);
    }
}

TEST_CASE("points that coincide share a leaf, however many they are") {
    std::vector<glm::dvec3> points(20000, glm::dvec3(0.25, 0.5, 0.75));
    points.emplace_back(1.0, 1.0, 1.0);
    const PointOctree octree = build_point_octree(points);
    CHECK(octree.nodes.size() == 3);
    CHECK(leaf_depth_histogram(octree.nodes) == std::vector<std::uint32_t>{0, 2});
}

TEST_CASE("points too near to each other to be divided end at the greatest depth") {
    const std::vector<glm::dvec3> points{glm::dvec3(0.0), glm::dvec3(1.0),
                                         glm::dvec3(0x1p-90, 0.0, 0.0), glm::dvec3(0x1p-20)};
    const PointOctree octree = build_point_octree(points);
    const std::vector<std::uint32_t> histogram = leaf_depth_histogram(octree.nodes);
    REQUIRE(histogram.size() == 49);
    CHECK(histogram[48] == 1);
    CHECK(histogram[1] == 1);   // The far corner.
    CHECK(histogram[20] == 1);  // 2^-20 is the center of a node of depth 19.
    CHECK(std::accumulate(histogram.begin(), histogram.end(), 0u) == 3);
    CHECK(leaf_depth_histogram(build_point_octree(points, {1, 5}).nodes).size() == 6);
}

TEST_CASE("points without extent along an axis are divided along the others") {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 256; ++i) points.emplace_back(i / 255.0, -3.0, 0.0);
    const std::vector<std::uint32_t> histogram =
        leaf_depth_histogram(build_point_octree(points).nodes);
    CHECK(std::accumulate(histogram.begin(), histogram.end(), 0u) == 256);
    CHECK(histogram.size() <= 10);
}

}  // namespace
}  // namespace rimline
