#pragma once

// The thesis's own index, as its third chapter describes it: slow by today's measure, and the yardstick
// for its figures. (HoughOctree is the one to use.)
//
//   3.2.1  A face is the foot point of its plane (hough_point.h), a silhouette point a v-sphere.
//   3.2.2  SFO edges, on the silhouette as seen from the origin, are listed apart.
//   3.3    Octree with one point a leaf (point_octree.h). A node has three boxes: its octant (OBV, in
//          search_cells.h), the tightest of its points (PBV), and the tightest of its points and those
//          that share an edge with one of them that is not SFO (EBV).
//   3.3.1  Neighbor graph (neighbor_graph.h).        3.4.4  Active-set candidates.
//   3.4.1  Static extraction. A subtree whose PBV is outside the v-sphere, or whose EBV is inside,
//          has no silhouette edge of its own: an edge is found from the one of its points that is
//          inside, so it is found once. "Recursion stops when the size of the node is sufficiently
//          small" is read as: a leaf of one point has no boxes to ask. So read, boxes an edge found are
//          those of Table 4.2's single origin (bunny 5.5, there 5.8; igea 4.7, there 5.1; radii 1 to
//          3); with the boxes of such leaves they are about twice as many.
//
// Where the text is exact, this is certain: a box settles what v_sphere.h can prove, is_front the rest.
// So every result equals brute force bit for bit, planes through the origin included: their boxes hold
// the origin, which lies on every v-sphere. What Corollary 1 cannot speak of is listed with the SFO
// edges: edges of a face without a plane, or whose plane may hold the origin, and non-manifold ones.

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
    /// Where Hough space has its origin, in the mesh's coordinates; the mesh's center when not given.
    /// Within k_max_coordinate.
    std::optional<glm::dvec3> origin;
    PointOctreeOptions octree;
    AscWeights asc_weights;
    /// What is in a leaf with no more faces than this is tested without asking the leaf's boxes. With 0,
    /// every box of every leaf is asked (and counted).
    std::uint32_t small_leaf = 1;
};

struct LiteralOctreeStatistics {
    std::uint32_t nodes = 0;
    std::uint32_t leaves = 0;
    std::uint32_t depth = 0;  ///< Of the deepest leaf; the root's is 0.
    std::uint32_t faces = 0;  ///< With a plane: those in the tree.
    std::uint32_t tree_edges = 0;
    // Listed apart:
    std::uint32_t sfo_edges = 0;
    std::uint32_t undecided_edges = 0;  ///< With a face whose plane holds the origin, or is none.
    std::uint32_t nonmanifold_edges = 0;
    // For the incremental update:
    std::uint32_t candidates = 0;
    std::uint32_t uncovered_leaves = 0;  ///< Candidates that the text does not make any.
    std::uint32_t empty_tiles = 0;
};

/// Immutable: any number of threads may use one.
class LiteralOctree {
public:
    struct Box {
        HoughBox box;
        float reach;  ///< The box's.
    };

    /// `mesh` must outlive the octree and stay where it is. O(faces * depth).
    explicit LiteralOctree(const Mesh& mesh, const LiteralOctreeOptions& options = {});
    explicit LiteralOctree(Mesh&&, const LiteralOctreeOptions& = {}) = delete;  // It would be gone.

    const Mesh& mesh() const noexcept { return *mesh_; }
    const glm::dvec3& origin() const noexcept { return origin_; }
    const LiteralOctreeStatistics& statistics() const noexcept { return statistics_; }

    /// Replaces `edges` by the silhouette from `point`, in no particular order (3.4.1). Borders are not
    /// among them. `counters` is added to: PBVs, then EBVs; a face check for each face of a leaf, and
    /// one for each of its neighbors where the face is inside; two for each edge listed apart.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 LiteralCounters& counters) const;

    /// The nodes, parents first. A node's faces are [begin, end) of what follows in tree order.
    std::span<const OctreeNode> nodes() const noexcept { return octree_.nodes; }
    std::span<const FaceId> faces() const noexcept { return faces_; }
    /// In the frame of the origin: Figure 3.1. Its dual point is H / |H|².
    std::span<const glm::dvec3> hough_points() const noexcept { return hough_points_; }
    /// The sign of dO (HoughPoint::side).
    std::span<const std::int8_t> sides() const noexcept { return sides_; }

    /// Whether its faces are tested without asking its boxes.
    bool is_small_leaf(const OctreeNode& node) const noexcept {
        return node.is_leaf() && node.size() <= small_leaf_;
    }

    /// By node.
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

    std::vector<std::int8_t> side_of_face_;  // By face; 0 without a plane.
    std::vector<bool> is_in_tree_;           // By edge.
    std::vector<EdgeId> listed_edges_;       // SFO and undecided ones.
};

}  // namespace rimline
