#include "silhouette/methods/literal/active_set_candidates.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/silhouette/methods/literal/octants.h"

namespace rimline {
namespace {

struct Parents {
    explicit Parents(const std::vector<OctreeNode>& nodes) : of(nodes.size(), k_no_node) {
        for (std::uint32_t i = 0; i < nodes.size(); ++i)
            for (const std::uint32_t child : nodes[i].children)
                if (child != k_no_node) of[child] = i;
    }
    std::vector<std::uint32_t> of;
};

// 3.4.4 literally: passes over all nodes, from the root, until nothing changes.
std::vector<bool> iterated(const std::vector<OctreeNode>& nodes,
                           const std::vector<NeighborNodes>& graph, std::uint32_t& sweeps) {
    const Parents parents(nodes);
    std::vector<bool> is_candidate(nodes.size(), false);
    const auto is_below_one = [&](std::uint32_t node) {
        while ((node = parents.of[node]) != k_no_node)
            if (is_candidate[node]) return true;
        return false;
    };
    for (bool changed = true; changed; ++sweeps) {
        changed = false;
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i].is_leaf() || is_candidate[i] || is_below_one(i)) continue;
            bool is_eligible = true;
            double sum = 0.0;
            std::uint32_t count = 0;
            for (const std::uint32_t child : nodes[i].children) {
                if (child == k_no_node || nodes[child].is_leaf()) continue;
                is_eligible &= is_candidate[child];
                sum += asc_cost(nodes, graph, child, {});
                ++count;
            }
            if (!is_eligible || (count > 0 && asc_cost(nodes, graph, i, {}) >= sum / count))
                continue;
            for (const std::uint32_t child : nodes[i].children)
                if (child != k_no_node) is_candidate[child] = false;
            is_candidate[i] = true;
            changed = true;
        }
    }
    return is_candidate;
}

TEST_CASE("candidates are those that the text's iteration ends with, and the leaves it left out") {
    const std::uint64_t seed = 3;
    CAPTURE(seed);
    for (const std::uint32_t bucket_size : {1u, 4u}) {
        const PointOctree octree =
            build_point_octree(tests::clustered_points(4000, seed), {bucket_size});
        const std::vector<NeighborNodes> graph = build_neighbor_graph(octree.nodes);
        const ActiveSetCandidates found = choose_active_set_candidates(octree.nodes, graph);
        std::uint32_t sweeps = 0;
        const std::vector<bool> expected = iterated(octree.nodes, graph, sweeps);
        CHECK(sweeps > 2);
        std::uint32_t leaves = 0;
        for (std::uint32_t i = 0; i < octree.nodes.size(); ++i) {
            const bool is_candidate =
                std::binary_search(found.candidates.begin(), found.candidates.end(), i);
            if (octree.nodes[i].is_leaf())
                leaves += is_candidate;
            else
                REQUIRE(is_candidate == expected[i]);
        }
        CHECK(leaves == found.uncovered_leaves);
        CHECK(leaves > 0);  // The text misses some.
    }
}

TEST_CASE("every leaf has exactly one candidate at or above it") {
    const PointOctree octree = build_point_octree(tests::clustered_points(4000, 4));
    const std::vector<NeighborNodes> graph = build_neighbor_graph(octree.nodes);
    const ActiveSetCandidates found = choose_active_set_candidates(octree.nodes, graph);
    const Parents parents(octree.nodes);
    for (std::uint32_t i = 0; i < octree.nodes.size(); ++i) {
        std::vector<std::uint32_t> above;
        for (std::uint32_t k = i; k != k_no_node; k = parents.of[k])
            if (std::binary_search(found.candidates.begin(), found.candidates.end(), k))
                above.push_back(k);
        REQUIRE(above.size() <= 1);
        CHECK(found.candidate_above[i] == (above.empty() ? k_no_node : above[0]));
        if (octree.nodes[i].is_leaf()) CHECK(above.size() == 1);
    }
}

TEST_CASE("costs are divided as reals") {
    // The root has leaves and one divided child, whose three neighbors have its own depth.
    const std::vector<glm::dvec3> points{glm::dvec3(0.0), glm::dvec3(1.0), {0.51, 0.0, 0.0},
                                         {1.0, 0.0, 0.0}, {1.0, 0.4, 0.4}, {1.0, 1.0, 0.0},
                                         {1.0, 0.0, 1.0}};
    const PointOctree octree = build_point_octree(points);
    const std::vector<NeighborNodes> graph = build_neighbor_graph(octree.nodes);
    const std::uint32_t child = octree.nodes[0].children[1];
    REQUIRE(octree.nodes[child].child_count == 3);
    CHECK(asc_cost(octree.nodes, graph, child, {}) == 2.0 * 1.0 / 3.0);
    CHECK(asc_cost(octree.nodes, graph, 0, {}) == 0.0);  // No depth, no neighbors.
    // So the root replaces them, and no leaf is left.
    const ActiveSetCandidates found = choose_active_set_candidates(octree.nodes, graph);
    CHECK(found.candidates == std::vector<std::uint32_t>{0});
    CHECK(found.uncovered_leaves == 0);
    CHECK(choose_active_set_candidates({}, {}).candidates.empty());
}

TEST_CASE("a neighbor's depth is weighted by w2") {
    // Octants 0 and 7 only: the neighbors of nodes in octant 0 are in it, or are the root.
    const std::vector<glm::dvec3> points{glm::dvec3(0.0), glm::dvec3(0.3), glm::dvec3(1.0)};
    const PointOctree octree = build_point_octree(points);
    const std::vector<NeighborNodes> graph = build_neighbor_graph(octree.nodes);
    const std::uint32_t child = octree.nodes[0].children[0];
    REQUIRE(octree.nodes[child].child_count == 2);
    CHECK(asc_cost(octree.nodes, graph, child, {}) == 2.0 * 1.0 / 2.0 + 0.25 * 1.0);
    CHECK(asc_cost(octree.nodes, graph, child, {0.0, 8.0}) == 8.0);
}

}  // namespace
}  // namespace rimline
