#include "silhouette/methods/literal/literal_forest.h"

#include <algorithm>

namespace rimline {

namespace {

// Whether an edge of two faces is certainly not SFO from one origin.
bool is_seen_apart(int side0, int side1, bool is_inconsistent) {
    return side0 != 0 && side1 != 0 && (side0 == side1) != is_inconsistent;
}

}  // namespace

class LiteralForest::Extraction {
public:
    Extraction(const LiteralForest& forest, const HomogeneousPoint& point,
               std::vector<EdgeId>& edges, LiteralCounters& work)
        : forest_(forest), mesh_(*forest.mesh_), point_(point), edges_(edges), work_(work) {}

    void run() {
        for (const Tree& tree : forest_.trees_)
            if (!tree.octree.nodes.empty())
                visit(tree, VSphere(point_, tree.origin, tree.greatest_reach), 0);
        for (const EdgeId edge : forest_.listed_edges_) test(edge, mesh_.faces_of(edge));
    }

private:
    void visit(const Tree& tree, const VSphere& sphere, std::uint32_t number) {
        const OctreeNode& node = tree.octree.nodes[number];
        if (!(node.is_leaf() && node.size() <= 1) && is_skipped(tree, sphere, number)) return;
        if (node.is_leaf())
            for (std::uint32_t i = node.begin; i < node.end; ++i) test_edges_of(tree, i);
        for (const std::uint32_t child : node.children)
            if (child != k_no_node) visit(tree, sphere, child);
    }

    bool is_skipped(const Tree& tree, const VSphere& sphere, std::uint32_t number) {
        const Box& related = tree.edge_boxes[number];
        if (forest_.options_.culling == LiteralCulling::straddling) {
            if (related.box.is_empty()) return true;
            ++work_.ebv_checks;
            return sphere.side_of(related.box, related.reach) != VSphereSide::mixed;
        }
        ++work_.pbv_checks;
        const Box& points = tree.point_boxes[number];
        if (sphere.side_of(points.box, points.reach) == VSphereSide::outside) return true;
        ++work_.ebv_checks;
        return sphere.side_of(related.box, related.reach) == VSphereSide::inside;
    }

    void test_edges_of(const Tree& tree, std::uint32_t i) {
        const std::span<const TreeEdge> edges =
            std::span(tree.edges)
                .subspan(tree.first_edge[i], tree.first_edge[i + 1] - tree.first_edge[i]);
        // No edge is below the leaf of a face without a side.
        if (tree.sides[i] == 0) return;
        if (edges.empty() && forest_.options_.culling == LiteralCulling::straddling) return;
        const bool is_inside = inside(tree.faces[i], tree.sides[i]);
        if (!is_inside && forest_.options_.culling == LiteralCulling::points_and_edges) return;
        for (const TreeEdge& edge : edges) {
            ++work_.edge_tests;
            if (inside(edge.other, edge.other_point.side) != is_inside) edges_.push_back(edge.edge);
        }
    }

    bool front(FaceId face) {
        ++work_.face_checks;
        return is_front(mesh_.plane(face), point_);
    }
    bool inside(FaceId face, int side) { return front(face) == (side > 0); }

    void test(EdgeId edge, std::span<const FaceId> faces) {
        ++work_.edge_tests;
        bool differ = false;
        const bool first = front(faces[0]);
        for (std::size_t i = 1; i < faces.size() && !differ; ++i) differ = front(faces[i]) != first;
        if (differ != (mesh_.edge_class(edge) == EdgeClass::inconsistent)) edges_.push_back(edge);
    }

    const LiteralForest& forest_;
    const Mesh& mesh_;
    HomogeneousPoint point_;
    std::vector<EdgeId>& edges_;
    LiteralCounters& work_;
};

LiteralForest::LiteralForest(const Mesh& mesh, std::span<const glm::dvec3> origins,
                             std::span<const std::uint32_t> face_groups,
                             const LiteralForestOptions& options)
    : mesh_(&mesh), options_(options), trees_(origins.size()) {
    RIMLINE_CHECK(face_groups.size() == mesh.face_count());
    const Mesh::EdgeRange border = mesh.edges_of_class(EdgeClass::border);
    std::vector<std::uint8_t> leaves(mesh.edge_count(), 0);
    for (std::uint32_t e = 0; e < border.first; ++e) {
        leaves[e] = leaves_of(EdgeId{e}, origins, face_groups);
        if (leaves[e] == 0)
            listed_edges_.push_back(EdgeId{e});
        else
            ++statistics_.tree_edges;
    }
    statistics_.listed_edges = static_cast<std::uint32_t>(listed_edges_.size());

    for (std::size_t g = 0; g < origins.size(); ++g) {
        Tree& tree = trees_[g];
        tree.origin = origins[g];
        std::vector<FaceId> faces;
        std::vector<glm::dvec3> positions;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            if (face_groups[f] != g || !mesh.plane(FaceId{f}).has_normal()) continue;
            faces.push_back(FaceId{f});
            positions.push_back(hough_point(mesh.plane(FaceId{f}), tree.origin).position);
        }
        tree.octree = build_point_octree(positions, options.octree);
        std::vector<HoughPoint> points;
        for (const std::uint32_t i : tree.octree.order) {
            const FaceId face = faces[i];
            points.push_back(hough_point(mesh.plane(face), tree.origin));
            tree.faces.push_back(face);
            tree.sides.push_back(static_cast<std::int8_t>(points.back().side));
            tree.first_edge.push_back(static_cast<std::uint32_t>(tree.edges.size()));
            for (const EdgeId edge : mesh.edges_of(face)) {
                if (edge == k_no_edge) continue;
                const std::array<FaceId, 2>& both = mesh.edge(edge).faces;
                const unsigned own = both[0] == face ? 0 : 1;
                if ((leaves[index(edge)] >> own & 1u) == 0) continue;
                const FaceId other = both[1 - own];
                tree.edges.push_back({edge, other, hough_point(mesh.plane(other), tree.origin)});
            }
        }
        tree.first_edge.push_back(static_cast<std::uint32_t>(tree.edges.size()));
        bound(tree, points);
    }
}

// The leaves that an edge is below: bit i for that of its face i. An edge below none is listed.
std::uint8_t LiteralForest::leaves_of(EdgeId edge, std::span<const glm::dvec3> origins,
                                      std::span<const std::uint32_t> groups) const {
    const EdgeClass edge_class = mesh_->edge_class(edge);
    if (edge_class == EdgeClass::nonmanifold) return 0;
    const std::array<FaceId, 2>& faces = mesh_->edge(edge).faces;
    for (const FaceId face : faces)
        if (!mesh_->plane(face).has_normal()) return 0;
    int sides[2][2];  // [origin][face].
    bool is_apart[2];
    for (std::size_t g = 0; g < 2; ++g) {
        for (std::size_t f = 0; f < 2; ++f)
            sides[g][f] =
                hough_point(mesh_->plane(faces[f]), origins[groups[index(faces[g])]]).side;
        is_apart[g] =
            is_seen_apart(sides[g][0], sides[g][1], edge_class == EdgeClass::inconsistent);
    }
    if (options_.listing == LiteralListing::sfo_from_any && !(is_apart[0] && is_apart[1])) return 0;
    if (options_.culling == LiteralCulling::straddling)
        return is_apart[0] ? 1 : (is_apart[1] ? 2 : 0);
    if (options_.listing == LiteralListing::sfo_from_all)
        return static_cast<std::uint8_t>((is_apart[0] ? 1 : 0) | (is_apart[1] ? 2 : 0));
    return sides[0][0] == sides[1][0] && sides[0][1] == sides[1][1] ? 3 : 0;
}

// From the leaves up: children are stored after their parents.
void LiteralForest::bound(Tree& tree, std::span<const HoughPoint> points) const {
    const std::vector<OctreeNode>& nodes = tree.octree.nodes;
    tree.point_boxes.resize(nodes.size());
    tree.edge_boxes.resize(nodes.size());
    const bool holds_points = options_.culling == LiteralCulling::points_and_edges;
    for (std::size_t n = nodes.size(); n-- > 0;) {
        const OctreeNode& node = nodes[n];
        HoughBox& point_box = tree.point_boxes[n].box;
        HoughBox& edge_box = tree.edge_boxes[n].box;
        for (std::uint32_t i = node.begin; node.is_leaf() && i < node.end; ++i) {
            point_box.include(points[i]);
            if (holds_points || tree.first_edge[i] != tree.first_edge[i + 1])
                edge_box.include(points[i]);
            for (std::uint32_t e = tree.first_edge[i]; e < tree.first_edge[i + 1]; ++e)
                edge_box.include(tree.edges[e].other_point);
        }
        for (const std::uint32_t child : node.children) {
            if (child == k_no_node) continue;
            point_box.include(tree.point_boxes[child].box);
            edge_box.include(tree.edge_boxes[child].box);
        }
        tree.point_boxes[n].reach = point_box.reach();
        tree.edge_boxes[n].reach = edge_box.reach();
    }
    if (!nodes.empty())
        tree.greatest_reach = std::max(tree.point_boxes[0].reach, tree.edge_boxes[0].reach);
}

void LiteralForest::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                            LiteralCounters& counters) const {
    RIMLINE_CHECK(point.is_valid());
    edges.clear();
    Extraction(*this, point, edges, counters).run();
}

}  // namespace rimline
