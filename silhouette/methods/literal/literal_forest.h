#pragma once

// The thesis's index with several origins (4.4.5): for each group of faces, an octree with one point a leaf
// over the faces' Hough points relative to the group's origin. It has static extraction only, with two ways
// to skip subtrees, to count the cost of each (Table 4.2, Figure 4.9).
//
//   points_and_edges  The thesis's way. A node with its PBV outside or its EBV inside is skipped. An edge is
//                     found from the one of its faces that is inside. That face must be the same from both
//                     faces' origins, or the edge is found twice or never. So the trees contain an edge if
//                     it is SFO from neither origin and each of its faces lies on the same side of both
//                     origins. (The text does not have the second condition.)
//   straddling        An edge belongs to the first of its faces from whose origin it is not SFO. A box
//                     contains both points of all edges that belong to a subtree. A node whose box is
//                     inside or outside is skipped.
//
// All other edges are listed and tested at every extraction. Every result equals brute force.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/hough/v_sphere.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/literal/literal_counters.h"
#include "silhouette/methods/literal/point_octree.h"

namespace rimline {

enum class LiteralCulling : std::uint8_t { points_and_edges, straddling };

struct LiteralForestStatistics {
    std::uint32_t tree_edges = 0;
    std::uint32_t listed_edges = 0;  ///< Tested at every extraction.
};

/// Immutable: any number of threads may use one.
class LiteralForest {
public:
    /// `face_groups` has an index into `origins` for each face, as HoughOctree::face_groups() has; the
    /// entries of faces without a plane have no meaning. `mesh` must outlive the forest and stay where it
    /// is. O(faces * depth).
    LiteralForest(const Mesh& mesh, std::span<const glm::dvec3> origins,
                  std::span<const std::uint32_t> face_groups, LiteralCulling culling,
                  const PointOctreeOptions& octree = {});
    LiteralForest(Mesh&&, std::span<const glm::dvec3>, std::span<const std::uint32_t>,
                  LiteralCulling, const PointOctreeOptions& = {}) = delete;  // It would dangle.

    /// The same as LiteralOctree::extract. With `straddling` a box counts as one EBV check.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 LiteralCounters& counters) const;

    const LiteralForestStatistics& statistics() const noexcept { return statistics_; }

private:
    class Extraction;

    // An edge of a face, with the other face's point relative to the origin of the first face's group.
    struct TreeEdge {
        EdgeId edge;
        FaceId other;
        HoughPoint other_point;
    };
    struct Box {
        HoughBox box;
        float reach = 0.0f;
    };
    struct Tree {
        glm::dvec3 origin{0.0};
        float greatest_reach = 0.0f;
        PointOctree octree;
        std::vector<Box> point_boxes, edge_boxes;  // One a node; no point boxes for `straddling`.
        // In tree order.
        std::vector<FaceId> faces;
        std::vector<std::int8_t> sides;
        std::vector<std::uint32_t> first_edge;  // Size: faces + 1.
        std::vector<TreeEdge> edges;
    };

    bool is_listed(EdgeId edge, std::span<const glm::dvec3> origins,
                   std::span<const std::uint32_t> groups, FaceId& owner) const;
    void bound(Tree& tree, std::span<const HoughPoint> points) const;

    const Mesh* mesh_;
    LiteralCulling culling_;
    LiteralForestStatistics statistics_;
    std::vector<Tree> trees_;
    std::vector<EdgeId> listed_edges_;
};

}  // namespace rimline
