#pragma once

// The thesis's index with several origins (4.4.5): for each group of faces, an octree with one point a leaf
// over the faces' Hough points relative to the group's origin. It has static extraction only, with two ways
// to skip subtrees and two lists of edges, to count the cost of each (Table 4.2, Figure 4.9).
//
// LiteralCulling:
//
//   points_and_edges  The thesis's way. A node with its PBV outside or its EBV inside is skipped. An edge is
//                     found from the one of its faces that is inside, below that face's leaf.
//   straddling        An edge is below the leaf of the first of its faces from whose origin it is in the
//                     trees. A box contains both points of all edges that belong to a subtree. A node whose
//                     box is inside or outside is skipped.
//
// LiteralListing, the edges that are tested at every extraction:
//
//   sfo_from_any      Those SFO from the origin of either of their faces. With points_and_edges also those
//                     with a face that lies on different sides of the two origins.
//   sfo_from_all      4.4.5: only those SFO from the origins of both faces.
//
// Every result equals brute force, except that of points_and_edges with sfo_from_all, which is the text to
// the letter and loses edges:
//
//   - An edge that is SFO from one of its two origins is below one of its faces alone. It is missed when that
//     face is outside and the other, a ghost, is inside: "ghost points do not contribute to PBVs".
//   - An edge that is SFO from neither, with a face on different sides of the two origins, can have both of
//     its faces inside, each relative to its own origin, or both outside. It is found twice or never.

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
enum class LiteralListing : std::uint8_t { sfo_from_any, sfo_from_all };

struct LiteralForestOptions {
    LiteralCulling culling = LiteralCulling::points_and_edges;
    LiteralListing listing = LiteralListing::sfo_from_any;
    PointOctreeOptions octree;

    /// Whether every result equals brute force.
    bool is_complete() const noexcept {
        return culling == LiteralCulling::straddling || listing == LiteralListing::sfo_from_any;
    }
};

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
                  std::span<const std::uint32_t> face_groups,
                  const LiteralForestOptions& options = {});
    LiteralForest(Mesh&&, std::span<const glm::dvec3>, std::span<const std::uint32_t>,
                  const LiteralForestOptions& = {}) = delete;  // It would dangle.

    /// The same as LiteralOctree::extract. With `straddling` a box counts as one EBV check. Unless the
    /// options are complete, `edges` may lack edges of the silhouette and have others twice.
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

    std::uint8_t leaves_of(EdgeId edge, std::span<const glm::dvec3> origins,
                           std::span<const std::uint32_t> groups) const;
    void bound(Tree& tree, std::span<const HoughPoint> points) const;

    const Mesh* mesh_;
    LiteralForestOptions options_;
    LiteralForestStatistics statistics_;
    std::vector<Tree> trees_;
    std::vector<EdgeId> listed_edges_;
};

}  // namespace rimline
