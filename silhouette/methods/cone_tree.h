#pragma once

// Anchored cones: regions from which all faces of a cluster are front, or all are back.
//
// P. Sander, X. Gu, S. Gortler, H. Hoppe, J. Snyder, Silhouette Clipping, SIGGRAPH 2000. In the
// intersection of the outer half-spaces of a cluster's faces, all of them are front. A cone with apex A,
// axis a and half angle π/2 - θ lies in this intersection if A does and all normals are within θ of a. From
// a viewpoint in this front cone, or in the back cone, which opens the other way, no edge of the cluster is
// on the silhouette. A direction is in a cone if its vector is.
//
// The authors merge edges bottom up, keep some in inner nodes and place apexes by linear programming.
// Here clusters are the nodes of a packed tree over edges with similar planes. The axis is nearly that of
// the smallest cone around the normals. An apex is the first point in all half-spaces on the line along the
// axis through the center of the cluster's vertices.
//
// Rounding: with u = 2^-24, m = 2^-18 and S = sin θ + m, a vector v = p - wA whose cosine to the axis
// exceeds S has n·v > |n||v| sin m for every normal n; and construction ensures n·A - d >= 2^-20 |n||A| for
// the apex as stored. With |p| <= |v| + w|A| that makes |n·p - w*d| five times as large as 3.1u|n||p|, the
// bound below which a bit may be wrong (v_sphere.h). Floats round v once, and v·a and |v|² in three
// products and two sums each: the cosine has an error of less than 16u = 2^-20, a quarter of m. Vectors so
// short that their squares may be subnormal are never in a cone. Directions, whose length has no meaning,
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
        Lanes sine_squared{};  // S²; infinite for a node without cones.
    };
    // Lanes whose front or back cone contains the point.
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
