#pragma once

// The inner loops of fields. They are compiled for every instruction set that Highway supports on the
// target, and chosen at run time. They compute in float and accumulate in double. k_near_radius and
// rounding_share bound the error.
//
// The error of a knot. A cluster uses the cubic P of the piece that contains its mean distance. Its
// distances are s = mean + t, |t| <= r. Let a knot have the distance a from the mean, and let s reach past
// it by o = r - a. Then f - P is (J2/2) x² + (J3/6) x³ at x = |t| - a beyond the knot, with J2 and J3 the
// jumps of f'' and f''' there. For several knots, these terms are added. As x <= o and x <= |t| o/r, the
// error of the cluster's sum is at most
//
//     W · var(s) · (o/r)² · (|J2|/2 + |J3|/6 · o).
//
// The error budget. On each level, clusters that cross no knot are summed. Let the others have the total
// weight U. A cluster of weight W is summed if its error is at most budget · W / U, and its error is
// subtracted from the budget. The remaining clusters are expanded into the next level. So the total error
// never exceeds the budget, and the unused part remains for the next levels.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "silhouette/field/plane_clusters.h"
#include "silhouette/field/tangential_function.h"

namespace rimline::kernels {

constexpr std::size_t k_max_knots = 32;

/// Points farther from the center would have too large rounding errors in their distances.
constexpr double k_near_radius = 4.0;

/// A tangential function in the form that the loops use.
struct FunctionTable {
    explicit FunctionTable(const TangentialFunction& function);

    std::uint32_t knot_count;
    std::array<float, k_max_knots> knot{};
    std::array<float, k_max_knots> jump2{};  ///< |J2|/2
    std::array<float, k_max_knots> jump3{};  ///< |J3|/6
    /// By piece: knot_count + 1 values, then zeros.
    std::array<float, k_max_knots + 1> start{}, c0{}, c1{}, c2{}, c3{};
    float min_vote, max_vote;
    float curvature;  ///< The maximum of |f''|/2.
    /// Upper bound of the rounding error of a sum in float, divided by the planes' total weight.
    double rounding_share;
};

/// The previous votes of eight clusters.
struct alignas(32) DiscountNode {
    std::array<float, k_cluster_fan> min_vote, max_vote;  ///< Limits of the planes' previous votes.
    std::array<float, k_cluster_fan> sum;                 ///< Weighted sum of the previous votes.
};

/// The previous votes of planes, in leaf order, and of clusters, by level.
struct Discount {
    std::vector<float> previous;
    std::vector<std::vector<DiscountNode>> levels;
};

/// Working memory for one thread at a time.
struct FieldScratch {
    // Uninitialized, because a point uses only a small part.
    std::unique_ptr<std::uint32_t[]> nodes, next, clusters;
    std::unique_ptr<float[]> value, error, weight;
    void reserve(const PlaneClusters& planes);
};

/// Counts of visited clusters and planes.
struct FieldWork {
    std::uint64_t clusters = 0;  ///< Eight per node.
    std::uint64_t planes = 0;    ///< All planes of each visited leaf.
};

/// The sum over all planes. With a discount, the sum of the votes above the previous votes.
double sum_planes(const PlaneClusters& planes, const FunctionTable& function,
                  const Discount* discount, const glm::dvec3& point);

/// The same, with an error of at most `budget` plus rounding.
double sum_clusters(const PlaneClusters& planes, const FunctionTable& function,
                    const Discount* discount, const glm::dvec3& point, double budget,
                    FieldScratch& scratch, FieldWork& work);

/// The instruction set in use, as named by Highway.
std::string_view field_instruction_set();

}  // namespace rimline::kernels
