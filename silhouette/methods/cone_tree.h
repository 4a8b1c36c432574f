#pragma once

// Anchored cones: where all faces of a cluster are front, and where all are back.
//
// P. Sander, X. Gu, S. Gortler, H. Hoppe, J. Snyder, Silhouette Clipping, SIGGRAPH 2000. Where the outer
// half-spaces of a cluster's faces meet, all of them are front. A cone with apex A, axis a and half
// angle π/2 - θ lies there when A does and all normals are within θ of a. From a viewpoint in this front
// cone, or in the back cone, which opens the other way, no edge of the cluster is on the silhouette. A
// direction is in a cone when it is as a vector.
//
// The authors merge edges bottom up, keep some in inner nodes and place apexes by linear programming.
// Here clusters are the nodes of a packed tree over edges with similar planes, the axis is nearly that
// of the smallest cone around the normals, and an apex is the first point of the axis, drawn through the
// middle of the cluster's vertices, that all half-spaces hold.
//
// When is that certain? With u = 2^-24, m = 2^-18 and S = sin θ + m, a vector v = p - wA whose cosine to
// the axis exceeds S has n·v > |n||v| sin m for every normal n; and n·A - d >= 2^-20 |n||A| is seen to at
// construction, on the apex as stored. With |p| <= |v| + w|A| that puts n·p - w*d beyond 3.1u|n||p|, by
// which a bit may be wrong (v_sphere.h), five times over. Floats round v once, and v·a and |v|² in three
// products and two sums each: the cosine is off by less than 16u = 2^-20, a quarter of m. Vectors so
// short that their squares might be subnormal settle nothing; directions, whose length does not matter,
// are scaled first.

#include <array>

#include "silhouette/methods/edge_leaves.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class ConeTree final : public SilhouetteMethod {
public:
    explicit ConeTree(const Mesh& mesh);

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;

private:
    using Lanes = std::array<float, k_fan_out>;
    struct alignas(64) Group {
        std::array<Lanes, 3> axis{}, front_apex{}, back_apex{};
        Lanes sine_squared{};  // S²; infinite for a node that has no cones.
    };
    // Lanes whose front or back cone holds the point.
    struct InCone {
        static std::uint32_t run(const Group& group, const HomogeneousPoint& p);
    };

    void build_cones(std::uint32_t level, std::uint32_t node, std::span<const EdgeId> edges);

    const Mesh* mesh_;
    PackedTree tree_;
    std::vector<Group> groups_;
    EdgeLeaves edge_leaves_;
    KernelPointer<InCone> in_cone_;
};

}  // namespace rimline
