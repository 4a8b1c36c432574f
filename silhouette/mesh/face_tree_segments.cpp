#include "silhouette/mesh/face_tree_segments.h"

namespace rimline {

void FaceTree::Segments::find_leaves(const FaceTree& tree) {
    leaves_.clear();
    open_.clear();
    const Node root{0, 0, static_cast<std::uint32_t>(tree.order_.size())};
    for (std::uint32_t i = 0; i < segments_.size(); ++i)
        if (segments_[i].may_meet(tree.boxes_[0])) open_.push_back({root, i});
    while (!open_.empty()) {
        next_.clear();
        for (const auto& [node, segment] : open_) {
            if (is_leaf(node)) {
                leaves_.push_back({node, segment});
                for (std::uint32_t i = node.first; i < node.last; ++i)
                    __builtin_prefetch(&tree.mesh_.triangles()[tree.order_[i]]);
                continue;
            }
            for (const Node& child : children_of(node)) {
                if (!segments_[segment].may_meet(tree.boxes_[child.number])) continue;
                next_.push_back({child, segment});
                if (is_leaf(child)) {
                    __builtin_prefetch(&tree.order_[child.first]);
                } else {
                    __builtin_prefetch(&tree.boxes_[2 * child.number + 1]);
                    __builtin_prefetch(&tree.boxes_[2 * child.number + 2].high.z);
                }
            }
        }
        open_.swap(next_);
    }
}

}  // namespace rimline
