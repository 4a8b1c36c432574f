#include "silhouette/methods/literal/neighbor_graph.h"

namespace rimline {

std::vector<NeighborNodes> build_neighbor_graph(std::span<const OctreeNode> nodes) {
    NeighborNodes none;
    none.fill(k_no_node);
    std::vector<NeighborNodes> graph(nodes.size(), none);
    for (std::uint32_t parent = 0; parent < nodes.size(); ++parent) {
        for (std::uint32_t octant = 0; octant < 8; ++octant) {
            const std::uint32_t child = nodes[parent].children[octant];
            if (child == k_no_node) continue;
            for (std::uint32_t direction = 0; direction < 6; ++direction) {
                const std::uint32_t axis = direction / 2;
                const std::uint32_t mirrored = octant ^ (1u << axis);
                const bool leaves_parent = (octant >> axis & 1u) == direction % 2;
                // The node that contains the neighbor point, no deeper than the parent.
                const std::uint32_t around = leaves_parent ? graph[parent][direction] : parent;
                if (around == k_no_node) continue;
                // A shallower node is a leaf, or contains the point in an empty octant.
                const bool may_have_it = nodes[around].depth == nodes[parent].depth;
                const std::uint32_t same_size =
                    may_have_it ? nodes[around].children[mirrored] : k_no_node;
                graph[child][direction] = same_size != k_no_node ? same_size : around;
            }
        }
    }
    return graph;
}

}  // namespace rimline
