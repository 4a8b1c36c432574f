#pragma once

// Dual quadrics: a node's planes bounded by a box and by an ellipsoid, rejected when either is missed.
//
// M. Soroka, C. Peters, S. Marschner, Quadric-Based Silhouette Sampling for Differentiable Rendering,
// ACM TOG (SIGGRAPH 2025), reject parts of a mesh without silhouettes by two approximations to their
// triangles' planes: a bounding box in dual space and dual quadrics. That pair is what is taken from
// there, and that the sign of a form y^T Q y decides. The quadric itself, an ellipsoid from the planes'
// covariance, is this file's own; theirs is fitted otherwise, and what they need it for, sampling edges
// by importance, is left out.
//
// The box is that of plane_boxes.h. As for the quadric, planes of a smooth patch are a thin sheet among
// the vectors x = (n, d - n·O), around which a box along the axes is mostly empty and an ellipsoid less
// so. With mean c and covariance M = LL^T of a cluster's planes, scaled until all of them have
// (x - c)^T M^-1 (x - c) <= 1, the silhouette point's hyperplane y misses the ellipsoid when
//
//     y^T Q y > 0   with   Q = cc^T - M,      that is      |c·y| > |L^T y|,
//
// and then no two planes of the cluster lie on different sides: none of its edges is on the silhouette.
// The second form is what is computed; it does not cancel.
//
// That is made certain whatever the covariance is like: each plane is solved for t in x - c = Lt + r,
// L is scaled by the greatest |t|, and what the solution leaves, |r|, goes into extents e like a box's:
//
//     |x·y - c·y|  =  |t·L^T y + r·y|  <=  |L^T y| + e·|y|.
//
// Margins as derived in plane_boxes.h: 16u(|c_i| + e_i + Σ_j|L_ij|) in each e_i, now for X that holds the
// ellipsoid too, and the fourth's share for the origin.

#include "silhouette/methods/edge_leaves.h"
#include "silhouette/methods/plane_boxes.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class QuadricTree final : public SilhouetteMethod {
public:
    explicit QuadricTree(const Mesh& mesh);

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    /// How many nodes each of the two tests has rejected in the last extraction.
    std::vector<NamedCount> own_counts() const override;

private:
    using Lanes = std::array<float, k_fan_out>;
    struct alignas(64) Group {
        std::array<Lanes, 4> center{}, extent{};
        std::array<Lanes, 10> root{};  // L by rows: 00, 10, 11, 20, 21, 22, 30, 31, 32, 33.
    };
    // Lanes whose ellipsoid the hyperplane misses.
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
