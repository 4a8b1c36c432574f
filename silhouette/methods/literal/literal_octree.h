#pragma once

// The thesis's own index, as its third chapter describes it. It is slow on today's machines and reproduces
// the thesis's figures. (Products use HoughOctree.)
//
//   3.2.1  A face is the foot point of its plane (hough_point.h), a silhouette point is a v-sphere.
//   3.2.2  SFO edges, on the silhouette from the origin, are listed separately.
//   3.3    Octree with one point a leaf (point_octree.h). A node has three boxes: its octant (OBV, in
//          search_cells.h), the tightest of its points (PBV), and the tightest of its points and of
//          the points that share with one of them an edge that is not SFO (EBV).
//   3.3.1  Neighbor graph (neighbor_graph.h).        3.4.4  Active-set candidates.
//   3.4.1  Static extraction. A subtree whose PBV is outside the v-sphere, or whose EBV is inside,
//          has no silhouette edge of its own: an edge is found from the one of its points that is inside,
//          so it is found once. "Recursion stops when the size of the node is sufficiently small" is read
//          as: a leaf of one point has no boxes. With this reading, the numbers of boxes an edge are those
//          of Table 4.2's single origin (bunny 5.5, there 5.8; igea 4.7, there 5.1; radii 1 to 3); with
//          boxes in such leaves they are about twice as large.
//
// The text computes with exact numbers, this code with certain bounds: a box decides what v_sphere.h can
// prove, is_front() decides the rest. So every result equals brute force bit for bit, also for planes
// through the origin: their boxes contain the origin, which lies on every v-sphere. Corollary 1 does not
// cover edges of a face without a plane or whose plane may contain the origin, and non-manifold edges; these
// are listed with the SFO edges.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/hough/v_sphere.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/literal/active_set_candidates.h"
#include "silhouette/methods/literal/literal_counters.h"
#include "silhouette/methods/literal/neighbor_graph.h"
#include "silhouette/methods/literal/point_octree.h"
#include "silhouette/methods/literal/search_cells.h"

namespace rimline {

struct LiteralOctreeOptions {
    /// The origin of Hough space, in the mesh's coordinates, within k_max_coordinate. By default the mesh's
    /// center.
    std::optional<glm::dvec3> origin;
    PointOctreeOptions octree;
    AscWeights asc_weights;
    /// A leaf with no more faces than this is searched without testing its boxes. With 0, every box of every
    /// leaf is tested (and counted).
    std::uint32_t small_leaf = 1;
};

struct LiteralOctreeStatistics {
    std::uint32_t nodes = 0;
    std::uint32_t leaves = 0;
    std::uint32_t depth = 0;  ///< Of the deepest leaf; the root has depth 0.
    std::uint32_t faces = 0;  ///< Faces with a plane; only these are in the tree.
    std::uint32_t tree_edges = 0;
    // Edges that are listed separately:
    std::uint32_t sfo_edges = 0;
    std::uint32_t undecided_edges =
        0;  ///< Of a face without a plane, or with the origin in its plane.
    std::uint32_t nonmanifold_edges = 0;
    // For the incremental update:
    std::uint32_t candidates = 0;
    std::uint32_t uncovered_leaves = 0;  ///< Candidates that are none in the text.
    std::uint32_t empty_tiles = 0;
};

/// Immutable: any number of threads may use one.
class LiteralOctree {
public:
    struct Box {
        HoughBox box;
        float reach;  ///< Of the box.
    };

    /// `mesh` must outlive the octree and stay where it is. O(faces * depth).
    explicit LiteralOctree(const Mesh& mesh, const LiteralOctreeOptions& options = {});
    explicit LiteralOctree(Mesh&&, const LiteralOctreeOptions& = {}) = delete;  // It would dangle.

    const Mesh& mesh() const noexcept { return *mesh_; }
    const glm::dvec3& origin() const noexcept { return origin_; }
    const LiteralOctreeStatistics& statistics() const noexcept { return statistics_; }

    /// Replaces `edges` by the silhouette from `point`, in no particular order (3.4.1). Borders are not
    /// among them. Adds to `counters`: PBVs, then EBVs; a face check for each face of a leaf, and one for
    /// each of its neighbors where the face is inside; two for each listed edge.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 LiteralCounters& counters) const;

    /// The nodes, parents first. A node's faces are [begin, end) of the spans in tree order below.
    std::span<const OctreeNode> nodes() const noexcept { return octree_.nodes; }
    std::span<const FaceId> faces() const noexcept { return faces_; }
    /// Relative to the origin (Figure 3.1). The dual point of H is H / |H|².
    std::span<const glm::dvec3> hough_points() const noexcept { return hough_points_; }
    /// The sign of dO (HoughPoint::side).
    std::span<const std::int8_t> sides() const noexcept { return sides_; }

    /// Whether the faces of `node` are tested without testing its boxes.
    bool is_small_leaf(const OctreeNode& node) const noexcept {
        return node.is_leaf() && node.size() <= small_leaf_;
    }

    /// One a node, as the following spans.
    std::span<const Box> point_boxes() const noexcept { return point_boxes_; }
    std::span<const Box> edge_boxes() const noexcept { return edge_boxes_; }
    std::span<const NeighborNodes> neighbors() const noexcept { return neighbors_; }
    const ActiveSetCandidates& candidates() const noexcept { return candidates_; }
    const SearchCells& search_cells() const noexcept { return cells_; }

    VSphere v_sphere(const HomogeneousPoint& point) const noexcept {
        return {point, origin_, greatest_reach_};
    }

private:
    class Extraction;

    void list_edges();
    void bound_nodes(std::span<const HoughPoint> points,
                     std::span<const std::uint32_t> position_of);
    void measure();

    const Mesh* mesh_;
    glm::dvec3 origin_;
    std::uint32_t small_leaf_;
    float greatest_reach_ = 0.0f;
    LiteralOctreeStatistics statistics_;

    PointOctree octree_;
    std::vector<Box> point_boxes_;
    std::vector<Box> edge_boxes_;
    std::vector<NeighborNodes> neighbors_;
    ActiveSetCandidates candidates_;
    SearchCells cells_;

    // In tree order.
    std::vector<FaceId> faces_;
    std::vector<glm::dvec3> hough_points_;
    std::vector<std::int8_t> sides_;

    std::vector<std::int8_t> side_of_face_;  // One a face; 0 without a plane.
    std::vector<bool> is_in_tree_;           // One an edge.
    std::vector<EdgeId> listed_edges_;       // SFO and undecided edges.
};

}  // namespace rimline
