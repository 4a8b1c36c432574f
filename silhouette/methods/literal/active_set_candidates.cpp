#include "silhouette/methods/literal/active_set_candidates.h"

namespace rimline {

double asc_cost(std::span<const OctreeNode> nodes, std::span<const NeighborNodes> neighbors,
                std::uint32_t node, const AscWeights& weights) {
    const double depth = nodes[node].depth;
    double difference = 0.0;
    std::uint32_t count = 0;
    for (const std::uint32_t neighbor : neighbors[node]) {
        if (neighbor == k_no_node) continue;
        // None is deeper.
        difference += depth - nodes[neighbor].depth;
        ++count;
    }
    const double neighbor_cost = count > 0 ? difference / count : 0.0;
    return weights.subtree * depth / nodes[node].child_count + weights.neighbor * neighbor_cost;
}

ActiveSetCandidates choose_active_set_candidates(std::span<const OctreeNode> nodes,
                                                 std::span<const NeighborNodes> neighbors,
                                                 const AscWeights& weights) {
    std::vector<bool> is_candidate(nodes.size(), false);
    for (auto i = static_cast<std::uint32_t>(nodes.size()); i-- > 0;) {
        const OctreeNode& node = nodes[i];
        if (node.is_leaf()) continue;
        double children_cost = 0.0;
        std::uint32_t candidate_children = 0;
        bool is_eligible = true;
        for (const std::uint32_t child : node.children) {
            if (child == k_no_node || nodes[child].is_leaf()) continue;
            is_eligible = is_eligible && is_candidate[child];
            children_cost += asc_cost(nodes, neighbors, child, weights);
            ++candidate_children;
        }
        if (!is_eligible) continue;
        if (candidate_children > 0 &&
            !(asc_cost(nodes, neighbors, i, weights) < children_cost / candidate_children))
            continue;
        is_candidate[i] = true;
        for (const std::uint32_t child : node.children)
            if (child != k_no_node) is_candidate[child] = false;
    }

    ActiveSetCandidates result;
    result.candidate_above.assign(nodes.size(), k_no_node);
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        std::uint32_t& above = result.candidate_above[i];
        if (above == k_no_node && nodes[i].is_leaf()) {
            is_candidate[i] = true;
            ++result.uncovered_leaves;
        }
        if (is_candidate[i]) {
            above = i;
            result.candidates.push_back(i);
        }
        for (const std::uint32_t child : nodes[i].children)
            if (child != k_no_node) result.candidate_above[child] = above;
    }
    return result;
}

}  // namespace rimline
