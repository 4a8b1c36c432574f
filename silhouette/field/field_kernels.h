#pragma once

// The loops that fields spend their time in, compiled for every instruction set that Highway knows for the
// target and chosen when the program runs. In float, flushed to double; k_near_radius and rounding_share
// say how far that is right.
//
// What a knot costs. A cluster takes the cubic P of the piece that its mean distance lies in. If its
// distances s = mean + t, |t| <= r, reach past a knot that is a from the mean, by o = r - a, then f - P is
// (J2/2) x² + (J3/6) x³ at x = |t| - a beyond it, with J2 and J3 the jumps of f'' and f''' there; of several
// knots passed, the sum. As x <= o and x <= |t| o/r, the cluster's sum errs by no more than
//
//     W · var(s) · (o/r)² · (|J2|/2 + |J3|/6 · o).
//
// What is to be spent. Level by level, clusters that cross no knot are summed. Of those that do, with
// weight U together, a cluster of weight W is summed if it errs by no more than budget · W / U, and the
// budget falls by that; the others are opened. So the budget is never exceeded, and what exact clusters
// and good ones do not need goes to the rest.

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

/// Points farther out have too large a rounding of their distances.
constexpr double k_near_radius = 4.0;

/// A tangential function as the loops need it.
struct FunctionTable {
    explicit FunctionTable(const TangentialFunction& function);

    std::uint32_t knot_count;
    std::array<float, k_max_knots> knot{};
    std::array<float, k_max_knots> jump2{};  ///< |J2|/2
    std::array<float, k_max_knots> jump3{};  ///< |J3|/6
    /// By piece, one more than there are knots; zeros after them.
    std::array<float, k_max_knots + 1> start{}, c0{}, c1{}, c2{}, c3{};
    float least, greatest;
    float curvature;  ///< The greatest |f''|/2.
    /// Of what is summed in float, at most: times the planes' weight.
    double rounding_share;
};

/// What earlier points took of each cluster's votes.
struct alignas(32) DiscountNode {
    std::array<float, k_cluster_fan> least, greatest;  ///< Of its planes' previous votes.
    std::array<float, k_cluster_fan> sum;              ///< Weighted.
};

/// Previous votes of planes, in leaf order, and of clusters, by level.
struct Discount {
    std::vector<float> previous;
    std::vector<std::vector<DiscountNode>> levels;
};

/// Room to work in, for one thread at a time.
struct FieldScratch {
    // Not set to anything, of which a point takes little whatever the mesh is.
    std::unique_ptr<std::uint32_t[]> nodes, next, clusters;
    std::unique_ptr<float[]> value, error, weight;
    void reserve(const PlaneClusters& planes);
};

/// How much was looked at.
struct FieldWork {
    std::uint64_t clusters = 0;  ///< Eight a node.
    std::uint64_t planes = 0;    ///< A leaf's all.
};

/// The sum over all planes; of what is above the previous votes if there is a discount.
double sum_planes(const PlaneClusters& planes, const FunctionTable& function,
                  const Discount* discount, const glm::dvec3& point);

/// The same, off by no more than `budget` and rounding.
double sum_clusters(const PlaneClusters& planes, const FunctionTable& function,
                    const Discount* discount, const glm::dvec3& point, double budget,
                    FieldScratch& scratch, FieldWork& work);

/// What is in use, as Highway names it.
std::string_view field_instruction_set();

}  // namespace rimline::kernels
