#pragma once

// Silhouettes by boxes of planes in four dimensions: the common part of plane_tree.h, dual_tree.h and
// gauss_map.h. These differ in how they map a plane to a point (plane_boxes.h).
//
//   Extraction. A tree of edges, whose boxes contain the planes of both faces of each edge. Where a box lies
//   certainly on one side of the point's hyperplane, none of its edges is on the silhouette.
//
//   Update. A tree of faces. Where a box is certainly on one side of both the old and the new
//   hyperplane, none of its faces turned if it is the same side, all of them if it is not.
//
// A negative factor exchanges the sides of a plane. An edge whose two faces have factors of different signs
// is on the silhouette when both points are on the *same* side, which no box can exclude. Such edges are
// tested at every extraction. So are edges with a face that is not placed, inconsistent edges and
// non-manifold edges. Faces that have a plane but are not placed are tested at every update.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/edge_leaves.h"
#include "silhouette/methods/followed_silhouette.h"
#include "silhouette/methods/plane_boxes.h"

namespace rimline {

struct PlacedPlane {
    PlaneBounds bounds{};
    int factor_sign = 0;  ///< The sign of the plane's factor; 0 where the plane is not placed.
};

/// The distance of a plane from an origin, d - n·O, in double, and a bound of its error.
struct OffsetPlane {
    double distance, error;
};
OffsetPlane offset_plane(const Plane& plane, const glm::dvec3& origin) noexcept;

class PlaneSpace {
public:
    /// Places a plane that has a normal.
    using Place = std::function<PlacedPlane(const Plane&)>;
    /// `weights` scale the coordinates when the distance of two planes is computed. `mesh` must outlive this
    /// object.
    PlaneSpace(const Mesh& mesh, const glm::dvec3& origin, const Place& place,
               const std::array<double, 4>& weights);

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) const;
    /// The first call tests every face and edge.
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters);

    /// The number of edges that are tested at every extraction.
    std::uint32_t untreed_edges() const noexcept { return edge_leaves_.rest_count(); }

private:
    void build_edges(std::span<const PlacedPlane> placed);
    void build_faces(std::span<const PlacedPlane> placed);
    PackedKey key_of(const PlaneBounds& bounds) const noexcept;

    void start_following(const HomogeneousPoint& point, TraversalCounters& counters);
    void find_flips(const HomogeneousPoint& from, const HomogeneousPoint& to,
                    TraversalCounters& counters);
    void flip(std::size_t block, std::uint32_t lanes);

    const Mesh* mesh_;
    glm::dvec3 origin_;
    std::array<double, 4> weights_;

    PlaneBoxes edge_boxes_;
    EdgeLeaves edge_leaves_;

    // Faces that have a plane, sixteen a block: first those of face_boxes_, then those that are not placed,
    // which start a new block.
    PlaneBoxes face_boxes_;
    struct FaceBlock {
        SixteenPlanes planes;
        std::array<FaceId, k_leaf_items> faces;
        std::uint32_t count;
        std::uint32_t bits;  // The face bits at followed_point_.
    };
    std::vector<FaceBlock> face_blocks_;
    std::size_t placed_blocks_ = 0;
    KernelPointer<FrontOfSixteen> front_ = best_version<FrontOfSixteen>();
    FollowedSilhouette followed_;
    HomogeneousPoint followed_point_{};
    std::vector<FaceId> flipped_;
};

}  // namespace rimline
