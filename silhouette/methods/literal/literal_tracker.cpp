#include "silhouette/methods/literal/literal_tracker.h"

namespace rimline {

LiteralTracker::LiteralTracker(const LiteralOctree& octree, const HomogeneousPoint& point,
                               const LiteralTrackerOptions& options)
    : octree_(&octree), options_(options), point_(point), followed_(octree.mesh()) {
    RIMLINE_CHECK(point.is_valid());
    const Mesh& mesh = octree.mesh();
    std::vector<std::uint32_t> face_words(face_word_count(mesh.face_count()), 0);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        if (is_front(mesh.plane(FaceId{f}), point)) face_words[f / 32] |= 1u << (f % 32);
    counters_.face_checks += mesh.face_count();

    std::vector<EdgeId> silhouette;
    octree.extract(point, silhouette, counters_);
    followed_.start(face_words, silhouette);

    if (options.update == LiteralUpdate::full_traversal) return;
    const std::size_t vertices = options.update == LiteralUpdate::incremental
                                     ? octree.search_cells().cells.size()
                                     : octree.nodes().size();
    tested_at_.assign(vertices, 0);
    enqueued_at_.assign(vertices, 0);
    sides_.assign(vertices, {VSphereSide::mixed, VSphereSide::mixed});
    begin_active_set();
}

const LiteralCounters& LiteralTracker::move_to(const HomogeneousPoint& point) {
    RIMLINE_CHECK(point.is_valid());
    counters_ = {};
    turned_.clear();
    const ActiveRegion region(octree_->v_sphere(point_), octree_->v_sphere(point));
    point_ = point;
    ++move_;
    if (!octree_->nodes().empty()) {
        switch (options_.update) {
            case LiteralUpdate::full_traversal: search(region, 0); break;
            case LiteralUpdate::incremental: walk(region); break;
            case LiteralUpdate::incremental_as_written: walk_as_written(region); break;
        }
    }
    counters_.edge_tests += followed_.update_edges(turned_);
    return counters_;
}

// 3.4.1, last paragraph: the nodes that meet the v-sphere of the first frame.
void LiteralTracker::begin_active_set() {
    if (octree_->nodes().empty()) return;
    const VSphere sphere = octree_->v_sphere(point_);
    ++move_;
    if (options_.update == LiteralUpdate::incremental_as_written) {
        begin_active_set_as_written(sphere, 0);
        return;
    }
    begin_active_set(ActiveRegion(sphere, sphere), 0);
}

void LiteralTracker::begin_active_set(const ActiveRegion& region, std::uint32_t cell) {
    if (sides_of_cell(region, cell).is_apart()) return;
    const OctreeNode& node = octree_->search_cells().cells[cell];
    if (node.is_leaf()) active_.push_back(cell);
    for (const std::uint32_t child : node.children)
        if (child != k_no_node) begin_active_set(region, child);
}

// 3.4.3, with the starts and cells that the header describes.
void LiteralTracker::walk(const ActiveRegion& region) {
    const SearchCells& cells = octree_->search_cells();
    queue_.clear();
    next_active_.clear();
    for (const std::uint32_t tile : active_) enqueue(tile);
    enqueue_boundary(region, 0);

    for (std::size_t head = 0; head < queue_.size(); ++head) {
        const std::uint32_t cell = queue_[head];
        const RegionSides sides = sides_of_cell(region, cell);
        if (sides.is_apart()) continue;
        if (!cells.cells[cell].is_leaf()) {
            // A neighbor of a tile, as large as the tile and divided further.
            for (const std::uint32_t child : cells.cells[cell].children) enqueue(child);
            continue;
        }
        if (sides.after == VSphereSide::mixed) next_active_.push_back(cell);
        if (cells.node_of[cell] != k_no_node) {
            if (sides.is_contained() && options_.turn_contained_nodes)
                turn_node(cells.cells[cell], sides.after);
            else
                search(region, cells.node_of[cell]);
        }
        for (const std::uint32_t neighbor : cells.neighbors[cell])
            if (neighbor != k_no_node) enqueue(neighbor);
    }
    active_.swap(next_active_);
}

void LiteralTracker::enqueue_boundary(const ActiveRegion& region, std::uint32_t cell) {
    const SearchCells& cells = octree_->search_cells();
    if (cells.root_faces[cell] == 0 || sides_of_cell(region, cell).is_apart()) return;
    if (cells.cells[cell].is_leaf()) {
        enqueue(cell);
        return;
    }
    for (const std::uint32_t child : cells.cells[cell].children) enqueue_boundary(region, child);
}

void LiteralTracker::enqueue(std::uint32_t vertex) {
    if (enqueued_at_[vertex] == move_) return;
    enqueued_at_[vertex] = move_;
    queue_.push_back(vertex);
    ++counters_.nodes_enqueued;
}

RegionSides LiteralTracker::sides_of_cell(const ActiveRegion& region, std::uint32_t cell) {
    if (tested_at_[cell] != move_) {
        const SearchCells& cells = octree_->search_cells();
        tested_at_[cell] = move_;
        sides_[cell] = region.sides_of(cells.boxes[cell], cells.reaches[cell]);
        ++counters_.obv_checks;
    }
    return sides_[cell];
}

// 3.4.2, from any node downwards.
void LiteralTracker::search(const ActiveRegion& region, std::uint32_t number) {
    const OctreeNode& node = octree_->nodes()[number];
    if (!octree_->is_small_leaf(node)) {
        const LiteralOctree::Box& points = octree_->point_boxes()[number];
        const RegionSides sides = region.sides_of(points.box, points.reach);
        ++counters_.pbv_checks;
        if (sides.is_apart()) return;
        if (sides.is_contained() && options_.turn_contained_nodes) {
            turn_node(node, sides.after);
            return;
        }
    }
    if (node.is_leaf()) check_faces(node);
    for (const std::uint32_t child : node.children)
        if (child != k_no_node) search(region, child);
}

// Turns all faces of a node. Their points are certainly on one side of the new v-sphere, so none is the
// origin.
void LiteralTracker::turn_node(const OctreeNode& node, VSphereSide after) {
    counters_.contained_faces += node.size();
    for (std::uint32_t i = node.begin; i < node.end; ++i)
        set_bit(octree_->faces()[i], (after == VSphereSide::inside) == (octree_->sides()[i] > 0));
}

void LiteralTracker::check_faces(const OctreeNode& node) {
    counters_.face_checks += node.size();
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const FaceId face = octree_->faces()[i];
        set_bit(face, is_front(octree_->mesh().plane(face), point_));
    }
}

void LiteralTracker::set_bit(FaceId face, bool front) {
    if (followed_.set_bit(face, front)) turned_.push_back(face);
}

}  // namespace rimline
