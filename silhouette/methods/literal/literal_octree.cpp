#include "silhouette/methods/literal/literal_octree.h"

namespace rimline {

// One static extraction (3.4.1).
class LiteralOctree::Extraction {
public:
    Extraction(const LiteralOctree& octree, const HomogeneousPoint& point,
               std::vector<EdgeId>& edges, LiteralCounters& work)
        : octree_(octree),
          mesh_(octree.mesh()),
          point_(point),
          sphere_(octree.v_sphere(point)),
          edges_(edges),
          work_(work) {}

    void visit(std::uint32_t number) {
        const OctreeNode& node = octree_.octree_.nodes[number];
        if (!octree_.is_small_leaf(node)) {
            ++work_.pbv_checks;
            const Box& points = octree_.point_boxes_[number];
            if (sphere_.side_of(points.box, points.reach) == VSphereSide::outside) return;
            ++work_.ebv_checks;
            const Box& related = octree_.edge_boxes_[number];
            if (sphere_.side_of(related.box, related.reach) == VSphereSide::inside) return;
        }
        if (node.is_leaf())
            for (std::uint32_t i = node.begin; i < node.end; ++i) test_edges_of(octree_.faces_[i]);
        for (const std::uint32_t child : node.children)
            if (child != k_no_node) visit(child);
    }

    void test_listed_edges() {
        for (const EdgeId edge : octree_.listed_edges_) test(edge, mesh_.edge(edge).faces);
        const Mesh::EdgeRange nonmanifold = mesh_.edges_of_class(EdgeClass::nonmanifold);
        for (std::uint32_t e = nonmanifold.first; e < nonmanifold.last; ++e)
            test(EdgeId{e}, mesh_.faces_of(EdgeId{e}));
    }

private:
    bool front(FaceId face) {
        ++work_.face_checks;
        return is_front(mesh_.plane(face), point_);
    }
    bool inside(FaceId face) { return front(face) == (octree_.side_of_face_[index(face)] > 0); }

    // By Corollary 1 an edge of the tree is on the silhouette when one of its two points is inside.
    void test_edges_of(FaceId face) {
        if (octree_.side_of_face_[index(face)] == 0 || !inside(face)) return;
        for (const EdgeId edge : mesh_.edges_of(face)) {
            if (edge == k_no_edge || !octree_.is_in_tree_[index(edge)]) continue;
            ++work_.edge_tests;
            const std::array<FaceId, 2>& faces = mesh_.edge(edge).faces;
            if (!inside(faces[0] == face ? faces[1] : faces[0])) edges_.push_back(edge);
        }
    }

    void test(EdgeId edge, std::span<const FaceId> faces) {
        ++work_.edge_tests;
        bool differ = false;
        const bool first = front(faces[0]);
        for (std::size_t i = 1; i < faces.size() && !differ; ++i) differ = front(faces[i]) != first;
        if (differ != (mesh_.edge_class(edge) == EdgeClass::inconsistent)) edges_.push_back(edge);
    }

    const LiteralOctree& octree_;
    const Mesh& mesh_;
    HomogeneousPoint point_;
    VSphere sphere_;
    std::vector<EdgeId>& edges_;
    LiteralCounters& work_;
};

void LiteralOctree::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                            LiteralCounters& counters) const {
    RIMLINE_CHECK(point.is_valid());
    edges.clear();
    Extraction extraction(*this, point, edges, counters);
    if (!octree_.nodes.empty()) extraction.visit(0);
    extraction.test_listed_edges();
}

}  // namespace rimline
