#pragma once

// Segments that look for their faces in a tree together. Each level of the tree is visited by all of them before the
// next: so what one of them needs next is on its way from memory while the others go on.

#include <cstdint>
#include <vector>

#include "silhouette/mesh/face_tree.h"

namespace rimline {

class FaceTree::Segments {
public:
    void clear() { segments_.clear(); }
    /// Segments are numbered from 0, in this order.
    void add(const glm::dvec3& from, const glm::dvec3& to) { segments_.emplace_back(from, to); }

    /// Calls visit(segment, face) for each segment and each face that it may meet, and some others, in no order.
    /// O(segments · log faces + what it visits).
    template <typename Visit>
    void each_along(const FaceTree& tree, Visit&& visit);

private:
    struct Visited {
        Node node;
        std::uint32_t segment;
    };
    void find_leaves(const FaceTree& tree);

    std::vector<Segment> segments_;
    std::vector<Visited> open_, next_, leaves_;
};

template <typename Visit>
void FaceTree::Segments::each_along(const FaceTree& tree, Visit&& visit) {
    constexpr std::size_t k_leaves_ahead = 4;
    const auto fetch_corners = [&](const Visited& leaf) {
        for (std::uint32_t i = leaf.node.first; i < leaf.node.last; ++i)
            for (const VertexId v : tree.mesh_.triangles()[tree.order_[i]])
                __builtin_prefetch(&tree.mesh_.positions()[index(v)]);
    };
    find_leaves(tree);
    for (std::size_t k = 0; k < leaves_.size(); ++k) {
        if (k + k_leaves_ahead < leaves_.size()) fetch_corners(leaves_[k + k_leaves_ahead]);
        const auto& [node, segment] = leaves_[k];
        for (std::uint32_t i = node.first; i < node.last; ++i) visit(segment, tree.order_[i]);
    }
}

}  // namespace rimline
