#pragma once

// Planes that lie close together in (n, d), under a tree, so that a field can sum them together.
//
// A cluster keeps its planes' weight W and the moments of x = (n, d) up to the third: the mean m, the
// covariance C, the third central moments T. For a point p and q = (p, -1), the signed distances s = x·q
// of its planes then have the mean m·q, the variance q'Cq, the third central moment T(q,q,q), and lie
// within a radius r of their mean. Where a cubic holds over all of these distances, its sum over the
// cluster follows from the moments exactly; field_kernels.h bounds what a knot among them costs.
//
// The radius is the lesser of two bounds: e·|q|, with e the greatest deviation of each component, and
// κ sqrt(q'(C + εI)q), with κ the greatest Mahalanobis distance. (Either alone visits a tenth to a
// third more clusters on igea.)
//
// The tree is implicit. Planes lie in k-d order, 32 a leaf; level 0 has a cluster for each leaf; eight
// clusters that follow each other are a node, and each node a cluster of the level above.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/field/unit_planes.h"

namespace rimline {

constexpr std::size_t k_cluster_fan = 8;
constexpr std::size_t k_leaf_planes = 32;

/// Eight clusters; weight 0 where there are fewer.
struct alignas(64) ClusterNode {
    using Lanes = std::array<float, k_cluster_fan>;
    Lanes weight;
    std::array<Lanes, 4> mean;
    std::array<Lanes, 4> extent;
    Lanes kappa_square;
    Lanes epsilon;
    std::array<Lanes, 10> covariance;  ///< xx xy xz xd yy yz yd zz zd dd, the mixed ones twice.
    std::array<Lanes, 20> third;  ///< xxx xxy .. ddd in the same order, each as often as it occurs.
};

/// Planes in leaf order. Those that fill up the last leaf have weight 0.
struct LeafPlanes {
    std::vector<float> nx, ny, nz, d, weight;
};

class PlaneClusters {
public:
    /// `weights`, one a plane, are not negative. O(planes log planes) on all threads; the same for any
    /// number of them.
    PlaneClusters(const UnitPlanes& planes, std::span<const double> weights);

    /// planes()'s order: the number in UnitPlanes of each, without what fills up the last leaf.
    std::span<const std::uint32_t> order() const noexcept { return order_; }
    const LeafPlanes& planes() const noexcept { return planes_; }
    std::size_t leaf_count() const noexcept { return planes_.d.size() / k_leaf_planes; }
    /// From the leaves' clusters up; the last has one node. Empty without planes.
    std::span<const std::vector<ClusterNode>> levels() const noexcept { return levels_; }

private:
    void sort(const UnitPlanes& planes, std::size_t first_leaf, std::size_t last_leaf);

    std::vector<std::uint32_t> order_;
    LeafPlanes planes_;
    std::vector<std::vector<ClusterNode>> levels_;
};

}  // namespace rimline
