#pragma once

// A tree of clusters of planes with similar (n, d), so that a field can sum a cluster at once.
//
// A cluster stores the weight W of its planes and the moments of x = (n, d) up to the third: the mean m,
// the covariance C and the third central moments T. Let p be a point and q = (p, -1). The signed
// distances s = x·q of the planes have the mean m·q, the variance q'Cq and the third central moment
// T(q,q,q), and lie within a radius r of their mean. If one cubic applies to all these distances, its
// sum over the cluster follows exactly from the moments. field_kernels.h bounds the error caused by a
// knot among them.
//
// The radius is the smaller of two bounds: e·|q|, with e the maximum deviation of each component, and κ
// sqrt(q'(C + εI)q), with κ the maximum Mahalanobis distance. (On igea, each bound alone visits a tenth
// to a third more clusters.)
//
// The tree is implicit. Planes are in k-d order, 32 per leaf. Level 0 has one cluster per leaf. Eight
// consecutive clusters form a node, and each node is a cluster of the next higher level.

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/field/unit_planes.h"

namespace rimline {

constexpr std::size_t k_cluster_fan = 8;
constexpr std::size_t k_leaf_planes = 32;

/// Eight clusters. Unused ones have weight 0.
struct alignas(64) ClusterNode {
    using Lanes = std::array<float, k_cluster_fan>;
    Lanes weight;
    std::array<Lanes, 4> mean;
    std::array<Lanes, 4> extent;
    Lanes kappa_square;
    Lanes epsilon;
    std::array<Lanes, 10> covariance;  ///< xx xy xz xd yy yz yd zz zd dd; mixed ones doubled.
    std::array<Lanes, 20> third;       ///< xxx xxy .. ddd in this order, times their multiplicity.
};

/// Planes in leaf order. Padding in the last leaf has weight 0.
struct LeafPlanes {
    std::vector<float> nx, ny, nz, d, weight;
};

class PlaneClusters {
public:
    /// `weights` has one nonnegative weight per plane. O(planes log planes) on all threads, with 48 bytes
    /// a plane meanwhile. The result does not depend on the number of threads. Throws Error{cancelled} if `stop` is
    /// requested.
    PlaneClusters(const UnitPlanes& planes, std::span<const double> weights,
                  const std::stop_token& stop = {});

    /// The order of planes(): the number of each plane in UnitPlanes, without padding.
    std::span<const std::uint32_t> order() const noexcept { return order_; }
    const LeafPlanes& planes() const noexcept { return planes_; }
    std::size_t leaf_count() const noexcept { return planes_.d.size() / k_leaf_planes; }
    /// Levels from the leaves up. The last has one node. Empty without planes.
    std::span<const std::vector<ClusterNode>> levels() const noexcept { return levels_; }

private:
    std::vector<std::uint32_t> order_;
    LeafPlanes planes_;
    std::vector<std::vector<ClusterNode>> levels_;
};

}  // namespace rimline
