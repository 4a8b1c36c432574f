#pragma once

// The nodes that may be in the active set (thesis 3.4.4). Leaves would make walks long; with nodes near the
// root a walk would be a full traversal. Every leaf has exactly one active-set candidate (ASC) at or
// above it, so candidates and empty octants beside or above them fill the root.
//
//     cost(node) = w1 * depth / children + w2 * mean over neighbors n of |depth - depth(n)|
//
// A node whose children are all leaves is a candidate. A node whose children are leaves and candidates
// replaces them when its cost is less than the mean of its candidates'. Costs do not change, so one pass
// from the deepest nodes up has the result of the text's "iterate until no changes".
//
// Where the text is ambiguous or wrong: divisions are of reals (of integers most costs would be equal);
// leaves have no children and no cost, and do not count in the mean; a leaf beside a child that never became
// a candidate would have no candidate above it, so the leaf becomes one itself.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/methods/literal/neighbor_graph.h"
#include "silhouette/methods/literal/point_octree.h"

namespace rimline {

struct AscWeights {
    double subtree = 2.0;    ///< The thesis's w1.
    double neighbor = 0.25;  ///< The thesis's w2.
};

/// The cost of a node that has children.
double asc_cost(std::span<const OctreeNode> nodes, std::span<const NeighborNodes> neighbors,
                std::uint32_t node, const AscWeights& weights);

struct ActiveSetCandidates {
    std::vector<std::uint32_t> candidates;  ///< Ascending.
    /// For each node: itself or its ancestor that is a candidate; k_no_node above all candidates.
    std::vector<std::uint32_t> candidate_above;
    std::uint32_t uncovered_leaves = 0;  ///< Candidates that are none in the text.
};

/// O(nodes).
ActiveSetCandidates choose_active_set_candidates(std::span<const OctreeNode> nodes,
                                                 std::span<const NeighborNodes> neighbors,
                                                 const AscWeights& weights = {});

}  // namespace rimline
