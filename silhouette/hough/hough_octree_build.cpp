#include <algorithm>
#include <cmath>
#include <numeric>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/octree_order.h"

namespace rimline {

HoughOctree::HoughOctree(const Mesh& mesh, const HoughOctreeOptions& options)
    : mesh_(&mesh), origin_(options.origin.value_or(mesh.center())) {
    for (int i = 0; i < 3; ++i) RIMLINE_CHECK(std::abs(origin_[i]) <= double{k_max_coordinate});

    std::vector<FaceId> faces;
    std::vector<HoughPoint> points;
    std::vector<glm::dvec3> positions;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Plane& plane = mesh.plane(FaceId{f});
        if (!plane.has_normal()) continue;
        faces.push_back(FaceId{f});
        points.push_back(hough_point(plane, origin_));
        positions.push_back(points.back().position);
    }
    const OctreeOrder tree = octree_order(positions, options.bucket_size);
    std::vector<HoughPoint> ordered;
    ordered.reserve(points.size());
    for (const std::uint32_t i : tree.order) {
        ordered.push_back(points[i]);
        faces_.push_back(faces[i]);
        planes_.push_back(mesh.plane(faces[i]));
    }
    planes_.push_back({0.0f, 0.0f, 0.0f, 0.0f});

    face_nodes_.reserve(tree.cells.size());
    for (const OctreeCell& cell : tree.cells)
        face_nodes_.push_back(
            {HoughBox{}, 0.0f, cell.begin, cell.end, cell.first_child, cell.child_count});
    edge_nodes_ = face_nodes_;
    bound_nodes(face_nodes_,
                [&](HoughBox& box, std::uint32_t face) { box.include(ordered[face]); });
    build_edges(ordered);
    measure();
}

// Boxes of leaves from what they hold, boxes of parents from their children's, which come after them.
template <typename Include>
void HoughOctree::bound_nodes(std::vector<Node>& nodes, Include&& include) {
    for (std::size_t i = nodes.size(); i-- > 0;) {
        Node& node = nodes[i];
        if (node.child_count == 0)
            for (std::uint32_t k = node.begin; k < node.end; ++k) include(node.box, k);
        else
            for (std::uint32_t k = 0; k < node.child_count; ++k)
                node.box.include(nodes[node.first_child + k].box);
        node.reach = node.box.reach();
    }
}

void HoughOctree::build_edges(std::span<const HoughPoint> points) {
    const auto face_count = static_cast<std::uint32_t>(faces_.size());
    std::vector<std::uint32_t> position_of(mesh_->face_count(), face_count);
    for (std::uint32_t i = 0; i < face_count; ++i) position_of[index(faces_[i])] = i;

    // An edge is owned by whichever of its faces comes first in tree order.
    struct FacePair {
        std::uint32_t first, second;
        EdgeId edge;
    };
    std::vector<FacePair> owned;
    std::vector<FacePair> tested_always;
    const Mesh::EdgeRange inconsistent = mesh_->edges_of_class(EdgeClass::inconsistent);
    for (std::uint32_t e = 0; e < inconsistent.last; ++e) {
        const std::array<FaceId, 2>& faces = mesh_->edge(EdgeId{e}).faces;
        const auto [a, b] = std::minmax(position_of[index(faces[0])], position_of[index(faces[1])]);
        const bool undecided = b == face_count || points[a].side == 0 || points[b].side == 0;
        const bool sfo =
            !undecided && (points[a].side != points[b].side) != (e >= inconsistent.first);
        (undecided || sfo ? tested_always : owned).push_back({a, b, EdgeId{e}});
        statistics_.undecided_edges += undecided;
        statistics_.sfo_edges += sfo;
    }
    const auto record = [&](std::vector<FacePair>& pairs) {
        std::sort(pairs.begin(), pairs.end(), [](const FacePair& a, const FacePair& b) {
            return a.first != b.first ? a.first < b.first : index(a.edge) < index(b.edge);
        });
        std::vector<EdgeRecord> records;
        records.reserve(pairs.size());
        for (const FacePair& pair : pairs)
            records.push_back({pair.first, pair.edge, planes_[pair.second]});
        return records;
    };
    edges_ = record(owned);
    explicit_edges_ = record(tested_always);

    std::vector<std::uint32_t> owned_begin(face_count + 1, 0);
    for (const FacePair& pair : owned) ++owned_begin[pair.first + 1];
    std::partial_sum(owned_begin.begin(), owned_begin.end(), owned_begin.begin());
    for (Node& node : edge_nodes_) {
        node.begin = owned_begin[node.begin];
        node.end = owned_begin[node.end];
    }
    bound_nodes(edge_nodes_, [&](HoughBox& box, std::uint32_t edge) {
        box.include(points[owned[edge].first]);
        box.include(points[owned[edge].second]);
    });
}

void HoughOctree::measure() {
    statistics_.nodes = static_cast<std::uint32_t>(face_nodes_.size());
    statistics_.faces = static_cast<std::uint32_t>(faces_.size());
    statistics_.owned_edges = static_cast<std::uint32_t>(edges_.size());
    statistics_.nonmanifold_edges = mesh_->edges_of_class(EdgeClass::nonmanifold).size();
    std::vector<std::uint32_t> depth(face_nodes_.size(), 0);
    for (std::size_t i = 0; i < face_nodes_.size(); ++i) {
        const Node& node = face_nodes_[i];
        statistics_.leaves += node.child_count == 0;
        statistics_.depth = std::max(statistics_.depth, depth[i]);
        for (std::uint32_t k = 0; k < node.child_count; ++k)
            depth[node.first_child + k] = depth[i] + 1;
    }
}

}  // namespace rimline
