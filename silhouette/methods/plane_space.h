#pragma once

// Silhouettes by boxes of planes in four dimensions: what plane_tree.h, dual_tree.h and gauss_map.h
// share. They differ in where they place a plane (plane_boxes.h).
//
//   Extraction. A tree of edges, whose boxes hold the planes of both their faces. Where a box lies
//   certainly on one side of the point's hyperplane, no edge of it is on the silhouette.
//
//   Update. A tree of faces. Where a box is certainly on one side of both the old and the new
//   hyperplane, none of its faces turned, or all of them did if these are different sides.
//
// A factor that is negative for some planes changes their sides: an edge whose faces disagree in it is
// on the silhouette when both are on the *same* side, which no box can exclude. Such edges, and those
// with a face that is not placed, are tested at every extraction, as are inconsistent and non-manifold
// ones; faces that have a plane but are not placed, at every update.

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
    int factor_sign = 0;  ///< Of what the plane was divided by; 0: it is not placed.
};

/// The distance of a plane from an origin, d - n·O, in double, and how far the exact one may be off.
struct OffsetPlane {
    double distance, error;
};
OffsetPlane offset_plane(const Plane& plane, const glm::dvec3& origin) noexcept;

class PlaneSpace {
public:
    /// Places a plane that has a normal.
    using Place = std::function<PlacedPlane(const Plane&)>;
    /// `weights` say how coordinates compare when planes are told near or far. `mesh` must outlive it.
    PlaneSpace(const Mesh& mesh, const glm::dvec3& origin, const Place& place,
               const std::array<double, 4>& weights);

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) const;
    /// The first call tests every face and edge.
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters);

    /// Edges tested at every extraction.
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

    // Faces that have a plane, sixteen a block: those of face_boxes_, then, from a block of their own,
    // those that are not placed.
    PlaneBoxes face_boxes_;
    struct FaceBlock {
        SixteenPlanes planes;
        std::array<FaceId, k_leaf_items> faces;
        std::uint32_t count;
        std::uint32_t bits;  // As of followed_point_.
    };
    std::vector<FaceBlock> face_blocks_;
    std::size_t placed_blocks_ = 0;
    KernelPointer<FrontOfSixteen> front_ = best_version<FrontOfSixteen>();
    FollowedSilhouette followed_;
    HomogeneousPoint followed_point_{};
    std::vector<FaceId> flipped_;
};

}  // namespace rimline
