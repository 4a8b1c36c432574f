#include "silhouette/methods/literal/neighbor_graph.h"

#include <doctest/doctest.h>

#include "tests/silhouette/methods/literal/octants.h"

namespace rimline {
namespace {

// The definition of 3.3.1, by the neighbor point and all nodes.
std::uint32_t neighbor_by_point(const PointOctree& octree, const std::vector<Octant>& octants,
                                std::uint32_t node, int direction) {
    const Octant& own = octants[node];
    glm::dvec3 point = own.center();
    const int axis = direction / 2;
    const double width = own.high[axis] - own.low[axis];
    point[axis] += direction % 2 == 0 ? -width : width;
    std::uint32_t deepest = k_no_node;
    for (std::uint32_t i = 0; i < octree.nodes.size(); ++i)
        if (octree.nodes[i].depth <= octree.nodes[node].depth && tests::holds(octants[i], point) &&
            (deepest == k_no_node || octree.nodes[i].depth > octree.nodes[deepest].depth))
            deepest = i;
    return deepest;
}

TEST_CASE("neighbors are the deepest nodes, no deeper, that hold the neighbor points") {
    const std::uint64_t seed = 2;
    CAPTURE(seed);
    const PointOctree octree = build_point_octree(tests::clustered_points(900, seed));
    const std::vector<Octant> octants = tests::octants_of(octree.nodes, octree.root);
    const std::vector<NeighborNodes> graph = build_neighbor_graph(octree.nodes);
    REQUIRE(graph.size() == octree.nodes.size());
    std::uint32_t same_depth = 0;
    std::uint32_t shallower = 0;
    std::uint32_t none = 0;
    for (std::uint32_t i = 0; i < graph.size(); ++i)
        for (int direction = 0; direction < 6; ++direction) {
            const std::uint32_t found = graph[i][static_cast<std::size_t>(direction)];
            CAPTURE(i);
            CAPTURE(direction);
            REQUIRE(found == neighbor_by_point(octree, octants, i, direction));
            if (found == k_no_node)
                ++none;
            else
                ++(octree.nodes[found].depth == octree.nodes[i].depth ? same_depth : shallower);
        }
    // All kinds were met.
    CHECK(same_depth > 100);
    CHECK(shallower > 100);
    CHECK(none > 100);
}

TEST_CASE("the relation is not symmetric, and a node's neighbor may be its parent") {
    // Figure 3.5: octants 0, 1 and 3 hold points, octant 2 is empty, and octant 1 is divided.
    const std::vector<glm::dvec3> points{
        glm::dvec3(0.0), glm::dvec3(1.0), {0.51, 0.0, 0.0}, {1.0, 0.0, 0.49}, {1.0, 1.0, 0.0}};
    const PointOctree octree = build_point_octree(points);
    const std::vector<NeighborNodes> graph = build_neighbor_graph(octree.nodes);
    const OctreeNode& root = octree.nodes[0];
    REQUIRE(root.children[2] == k_no_node);
    constexpr std::size_t k_plus_x = 1;
    constexpr std::size_t k_minus_x = 0;
    constexpr std::size_t k_plus_y = 3;
    CHECK(graph[root.children[0]][k_plus_x] == root.children[1]);
    CHECK(graph[root.children[0]][k_plus_y] == 0);
    CHECK(graph[root.children[3]][k_minus_x] == 0);
    // Deeper nodes lead to a larger one that does not lead back to them.
    const OctreeNode& divided = octree.nodes[root.children[1]];
    REQUIRE(!divided.is_leaf());
    REQUIRE(divided.children[0] != k_no_node);
    CHECK(graph[divided.children[0]][k_minus_x] == root.children[0]);
    for (const std::uint32_t neighbor : graph[0]) CHECK(neighbor == k_no_node);
}

}  // namespace
}  // namespace rimline
