#pragma once

// The thesis's index with several origins (4.4.5): an octree of one-point leaves for each group of faces,
// over their Hough points as seen from the group's origin. Static extraction alone, and two ways to skip
// subtrees, to count what each costs (Table 4.2, Figure 4.9).
//
//   points_and_edges  The thesis's: what has its PBV outside or its EBV inside is skipped, and an edge is
//                     found from the one of its faces that is inside. That face must be the same from both
//                     faces' origins, or the edge is found twice or never: so an edge is in the trees where
//                     it is SFO from neither origin and each of its faces lies on the same side of both.
//                     (The text leaves out the second half.)
//   straddling        An edge belongs to the first of its faces from whose origin it is not SFO. A box
//                     holds both points of all edges that belong to a subtree, and what lies wholly
//                     inside or outside is skipped.
//
// All other edges are listed, and tested at every extraction. Every result equals brute force.

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
    /// One group for each face, a number in `origins`; those of faces without a plane count for nothing
    /// (HoughOctree::face_groups()). `mesh` must outlive the forest and stay where it is.
    /// O(faces * depth).
    LiteralForest(const Mesh& mesh, std::span<const glm::dvec3> origins,
                  std::span<const std::uint32_t> face_groups, LiteralCulling culling,
                  const PointOctreeOptions& octree = {});
    LiteralForest(Mesh&&, std::span<const glm::dvec3>, std::span<const std::uint32_t>,
                  LiteralCulling, const PointOctreeOptions& = {}) = delete;  // It would be gone.

    /// As LiteralOctree::extract. With `straddling` a box is one EBV check.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 LiteralCounters& counters) const;

    const LiteralForestStatistics& statistics() const noexcept { return statistics_; }

private:
    class Extraction;

    // From a face, as seen from its group's origin.
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
        std::vector<Box> point_boxes, edge_boxes;  // By node; the first not where straddling.
        // In tree order.
        std::vector<FaceId> faces;
        std::vector<std::int8_t> sides;
        std::vector<std::uint32_t> first_edge;  // One more than faces.
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
