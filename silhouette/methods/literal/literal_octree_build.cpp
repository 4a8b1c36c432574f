#include <algorithm>
#include <cmath>

#include "silhouette/methods/literal/literal_octree.h"

namespace rimline {

LiteralOctree::LiteralOctree(const Mesh& mesh, const LiteralOctreeOptions& options)
    : mesh_(&mesh),
      origin_(options.origin.value_or(mesh.center())),
      small_leaf_(options.small_leaf) {
    for (int axis = 0; axis < 3; ++axis)
        RIMLINE_CHECK(std::abs(origin_[axis]) <= double{k_max_coordinate});

    std::vector<FaceId> faces;
    std::vector<HoughPoint> points;
    std::vector<glm::dvec3> positions;
    double greatest_error = 0.0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Plane& plane = mesh.plane(FaceId{f});
        if (!plane.has_normal()) continue;
        faces.push_back(FaceId{f});
        points.push_back(hough_point(plane, origin_));
        positions.push_back(points.back().position);
        greatest_error = std::max(greatest_error, points.back().error);
    }
    octree_ = build_point_octree(positions, options.octree);

    std::vector<HoughPoint> ordered;
    ordered.reserve(points.size());
    side_of_face_.assign(mesh.face_count(), 0);
    std::vector<std::uint32_t> position_of(mesh.face_count(), k_no_node);
    for (const std::uint32_t i : octree_.order) {
        const auto side = static_cast<std::int8_t>(points[i].side);
        position_of[index(faces[i])] = static_cast<std::uint32_t>(ordered.size());
        side_of_face_[index(faces[i])] = side;
        ordered.push_back(points[i]);
        faces_.push_back(faces[i]);
        hough_points_.push_back(positions[i]);
        sides_.push_back(side);
    }
    list_edges();
    bound_nodes(ordered, position_of);

    neighbors_ = build_neighbor_graph(octree_.nodes);
    candidates_ = choose_active_set_candidates(octree_.nodes, neighbors_, options.asc_weights);
    cells_ = build_search_cells(octree_, candidates_, greatest_error);
    // All point boxes lie within the root's octant, which was widened by as much as any of them.
    if (!cells_.reaches.empty()) greatest_reach_ = cells_.reaches[0];
    measure();
}

// Corollary 1 holds for edges with two faces whose planes do not contain the origin. The tree contains those
// of them that are not SFO.
void LiteralOctree::list_edges() {
    const Mesh::EdgeRange inconsistent = mesh_->edges_of_class(EdgeClass::inconsistent);
    is_in_tree_.assign(mesh_->edge_count(), false);
    for (std::uint32_t e = 0; e < inconsistent.last; ++e) {
        const std::array<FaceId, 2>& faces = mesh_->edge(EdgeId{e}).faces;
        const std::int8_t a = side_of_face_[index(faces[0])];
        const std::int8_t b = side_of_face_[index(faces[1])];
        const bool is_undecided = a == 0 || b == 0;
        const bool is_sfo = !is_undecided && (a != b) != (e >= inconsistent.first);
        statistics_.undecided_edges += is_undecided;
        statistics_.sfo_edges += is_sfo;
        if (is_undecided || is_sfo)
            listed_edges_.push_back(EdgeId{e});
        else
            is_in_tree_[e] = true;
    }
    statistics_.tree_edges =
        inconsistent.last - statistics_.undecided_edges - statistics_.sfo_edges;
}

// PBVs and EBVs (3.3), from the leaves up: children are stored after their parents.
void LiteralOctree::bound_nodes(std::span<const HoughPoint> points,
                                std::span<const std::uint32_t> position_of) {
    point_boxes_.resize(octree_.nodes.size());
    edge_boxes_.resize(octree_.nodes.size());
    for (std::size_t i = octree_.nodes.size(); i-- > 0;) {
        const OctreeNode& node = octree_.nodes[i];
        HoughBox& point_box = point_boxes_[i].box;
        HoughBox& edge_box = edge_boxes_[i].box;
        if (node.is_leaf()) {
            for (std::uint32_t k = node.begin; k < node.end; ++k) {
                point_box.include(points[k]);
                for (const EdgeId edge : mesh_->edges_of(faces_[k])) {
                    if (edge == k_no_edge || !is_in_tree_[index(edge)]) continue;
                    for (const FaceId face : mesh_->edge(edge).faces)
                        edge_box.include(points[position_of[index(face)]]);
                }
            }
            edge_box.include(point_box);
        }
        for (const std::uint32_t child : node.children) {
            if (child == k_no_node) continue;
            point_box.include(point_boxes_[child].box);
            edge_box.include(edge_boxes_[child].box);
        }
        point_boxes_[i].reach = point_box.reach();
        edge_boxes_[i].reach = edge_box.reach();
    }
}

void LiteralOctree::measure() {
    statistics_.nodes = static_cast<std::uint32_t>(octree_.nodes.size());
    for (const OctreeNode& node : octree_.nodes) {
        statistics_.leaves += node.is_leaf();
        statistics_.depth = std::max(statistics_.depth, node.depth);
    }
    statistics_.faces = static_cast<std::uint32_t>(faces_.size());
    statistics_.nonmanifold_edges = mesh_->edges_of_class(EdgeClass::nonmanifold).size();
    statistics_.candidates = static_cast<std::uint32_t>(candidates_.candidates.size());
    statistics_.uncovered_leaves = candidates_.uncovered_leaves;
    statistics_.empty_tiles = cells_.empty_tiles;
}

}  // namespace rimline
