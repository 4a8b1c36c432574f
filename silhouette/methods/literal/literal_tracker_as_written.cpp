// The incremental update as 3.4.3 describes it, in the more favorable reading where the text is ambiguous: a
// walk that reaches a node below a candidate continues from the candidate, and one that reaches an ancestor
// searches the whole ancestor. It still misses faces (literal_tracker.h).

#include "silhouette/methods/literal/literal_tracker.h"

namespace rimline {

namespace {

// A leaf is no candidate in the text.
bool is_candidate(const LiteralOctree& octree, std::uint32_t node) {
    return octree.candidates().candidate_above[node] == node && !octree.nodes()[node].is_leaf();
}

}  // namespace

void LiteralTracker::begin_active_set_as_written(const VSphere& sphere, std::uint32_t number) {
    const LiteralOctree::Box& points = octree_->point_boxes()[number];
    ++counters_.pbv_checks;
    if (sphere.side_of(points.box, points.reach) != VSphereSide::mixed) return;
    if (is_candidate(*octree_, number)) {
        active_.push_back(number);
        return;
    }
    for (const std::uint32_t child : octree_->nodes()[number].children)
        if (child != k_no_node) begin_active_set_as_written(sphere, child);
}

void LiteralTracker::walk_as_written(const ActiveRegion& region) {
    queue_.clear();
    next_active_.clear();
    for (const std::uint32_t node : active_) enqueue(node);
    for (std::size_t head = 0; head < queue_.size(); ++head) {
        const std::uint32_t node = queue_[head];
        search_as_written(region, node);
        if (sides_[node].is_apart()) continue;
        for (const std::uint32_t neighbor : octree_->neighbors()[node]) {
            if (neighbor == k_no_node) continue;
            const std::uint32_t above = octree_->candidates().candidate_above[neighbor];
            enqueue(above != k_no_node ? above : neighbor);
        }
    }
    active_.swap(next_active_);
}

void LiteralTracker::search_as_written(const ActiveRegion& region, std::uint32_t number) {
    // Searched before, from a node above or from the queue.
    if (tested_at_[number] == move_) return;
    tested_at_[number] = move_;
    const OctreeNode& node = octree_->nodes()[number];
    if (octree_->is_small_leaf(node)) {
        sides_[number] = {VSphereSide::mixed, VSphereSide::mixed};
    } else {
        const LiteralOctree::Box& points = octree_->point_boxes()[number];
        const RegionSides sides = region.sides_of(points.box, points.reach);
        sides_[number] = sides;
        ++counters_.pbv_checks;
        if (sides.is_apart()) return;
        if (sides.after == VSphereSide::mixed && is_candidate(*octree_, number))
            next_active_.push_back(number);
        if (sides.is_contained() && options_.turn_contained_nodes) {
            turn_node(node, sides.after);
            return;
        }
    }
    if (node.is_leaf()) check_faces(node);
    for (const std::uint32_t child : node.children)
        if (child != k_no_node) search_as_written(region, child);
}

}  // namespace rimline
