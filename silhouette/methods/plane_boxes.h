#pragma once

// A tree of boxes of planes in four dimensions, and tests on which side of a hyperplane a box lies.
//
// A plane n·x = d is a vector x = (n, d - n·O) of four dimensions about an origin O, up to a factor; a
// silhouette point is the hyperplane x·y = 0 through the origin there, with y = (q, -w) and q = p - wO:
//
//     n·p - w*d  =  x·y        (times the factor that x was divided by)
//
// The factor distinguishes the methods: a factor of 1 gives plane space (plane_tree.h), d - n·O the
// geometric dual (dual_tree.h), and the normal's greatest component, without the fourth coordinate, the cube
// around the Gauss map (gauss_map.h). For a box of center c and half extents e (Hertzmann, Zorin 2000)
//
//     |c·y| > e·|y|   =>   the whole box lies on the side of c.
//
// Rounding: with u = 2^-24, X = |c| + e and sums over coordinates, a bit is that of the real value wherever
// |n·p - w*d| > 3.1u Σ|n_i p_i| (v_sphere.h). That requires 3.1u X·|y| and, as |p_i| <= |q_i| + w|O_i|,
// 3.1u Σ X_i|O_i| w. In floats q is rounded once (1.01u X·|y| on either side), c·y takes four products and
// three sums (4.1u), e·|y| the same and one sum more (5.1u). The sum is 14.3u, so extents are stored as
//
//     e_i + 16u X_i,        and the fourth has Σ X_i (4u|O_i| + 2^-140) more, for products with w,
//
// where 2^-140 is for subnormal products. The stored extents contain all margins, so a test computes none.
// Boxes decide bits only where these are certain, so the results equal brute force.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/methods/instruction_set.h"
#include "silhouette/methods/packed_tree.h"

namespace rimline {

/// The hyperplane of a silhouette point.
using PointForm = std::array<float, 4>;

PointForm form_of(const HomogeneousPoint& point, const glm::dvec3& origin) noexcept;

/// Bounds of the coordinates of one or more planes.
struct PlaneBounds {
    std::array<double, 4> low, high;

    static PlaneBounds none() noexcept;
    void include(const PlaneBounds& other) noexcept;
};

/// Lanes whose planes lie certainly on the positive or on the negative side.
struct CertainSides {
    std::uint32_t positive = 0;
    std::uint32_t negative = 0;
};

class PlaneBoxes {
public:
    PlaneBoxes() = default;
    /// `items` must be in packed_order, their bounds within 2^62.
    PlaneBoxes(const glm::dvec3& origin, std::span<const PlaneBounds> items);

    const PackedTree& tree() const noexcept { return tree_; }

    /// The sides of a group of siblings. The bits of lanes without a node have no meaning.
    CertainSides sides(std::uint32_t group, const PointForm& y) const noexcept {
        return kernel_(groups_[group], y);
    }

private:
    struct alignas(64) Group {
        std::array<std::array<float, k_fan_out>, 4> center{}, extent{};
    };
    struct Sides {
        static CertainSides run(const Group& group, const PointForm& y);
    };

    PackedTree tree_;
    std::vector<Group> groups_;
    KernelPointer<Sides> kernel_ = nullptr;
};

}  // namespace rimline
