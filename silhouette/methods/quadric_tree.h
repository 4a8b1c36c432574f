#pragma once

// Dual quadrics: a node's planes are bounded by a box and by an ellipsoid. The node is rejected when the
// hyperplane misses either of them.
//
// M. Soroka, C. Peters, S. Marschner, Quadric-Based Silhouette Sampling for Differentiable Rendering,
// ACM TOG (SIGGRAPH 2025), reject parts of a mesh without silhouettes by two approximations to their
// triangles' planes: a bounding box in dual space and dual quadrics. This file takes
// that pair from them, and the test by the sign of a form y^T Q y. The quadric itself, an ellipsoid from the
// planes' covariance, is our own; they fit theirs in another way. Their importance sampling of edges is left
// out.
//
// The box is that of plane_boxes.h. Planes of a smooth patch are a thin sheet among
// the vectors x = (n, d - n·O), around which a box along the axes is mostly empty and an ellipsoid less
// so. With mean c and covariance M = LL^T of a cluster's planes, scaled until all of them have
// (x - c)^T M^-1 (x - c) <= 1, the silhouette point's hyperplane y misses the ellipsoid when
//
//     y^T Q y > 0   with   Q = cc^T - M,      that is      |c·y| > |L^T y|,
//
// and then no two planes of the cluster lie on different sides: none of its edges is on the silhouette.
// The code computes the second form, which has no cancellation.
//
// Rounding cannot break this bound, whatever the covariance is: each plane is solved for t in x - c = Lt + r,
// L is scaled by the greatest |t|, and the remainders |r| are added to extents e like those of a box:
//
//     |x·y - c·y|  =  |t·L^T y + r·y|  <=  |L^T y| + e·|y|.
//
// Margins are those of plane_boxes.h: 16u(|c_i| + e_i + Σ_j|L_ij|) in each e_i, where X now includes the
// ellipsoid, and the share of the fourth coordinate for the origin.

#include "silhouette/methods/edge_leaves.h"
#include "silhouette/methods/plane_boxes.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class QuadricTree final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    explicit QuadricTree(const Mesh& mesh);

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    /// The number of nodes that each of the two tests rejected in the last extraction.
    std::vector<NamedCount> own_counts() const override;

private:
    using Lanes = std::array<float, k_fan_out>;
    struct alignas(64) Group {
        std::array<Lanes, 4> center{}, extent{};
        std::array<Lanes, 10> root{};  // L by rows: 00, 10, 11, 20, 21, 22, 30, 31, 32, 33.
    };
    // Lanes whose ellipsoid lies on one side of the hyperplane.
    struct Missed {
        static std::uint32_t run(const Group& group, const PointForm& y);
    };

    void build_quadric(std::uint32_t level, std::uint32_t node, std::span<const EdgeId> edges);

    const Mesh* mesh_;
    glm::dvec3 origin_;
    PlaneBoxes boxes_;
    std::vector<Group> groups_;
    EdgeLeaves edge_leaves_;
    KernelPointer<Missed> missed_;
    std::uint64_t rejected_by_box_ = 0;
    std::uint64_t rejected_by_quadric_ = 0;
};

}  // namespace rimline
