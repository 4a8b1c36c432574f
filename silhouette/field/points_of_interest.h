#pragma once

// Points of interest (thesis 4.2): the peaks of a field in a ball or shell around the mesh. They are found
// one after another. Each counts only votes that earlier points have not got (discounted_field.h).
//
// The domain is sampled on a lattice. The best local maxima of the samples start climbs. A climb evaluates
// a pattern of 27 points and moves to the best one. It halves the pattern if its center is the best, until
// the width is below the tolerance.
//
// With weights, candidates are the lattice samples and the peaks. Without, the best peak is chosen, and only the best
// two climbs continue after all patterns have shrunk to an eighth. Samples then only say where climbs start, so their
// sums may err by two tolerances of the field.
//
//   Weights. A candidate's score is its votes times a weight in [0, 1] (4.5.3: the visible share of the
//   silhouette). A weight may be expensive. Votes times a cheap bound of the weight bound scores, so
//   candidates are weighed in descending order of these until no other candidate can win. If weights vary
//   slowly, the peaks and a part of the lattice are sufficient (weighed_stride). Around the winner, patterns
//   of 7 points are weighed in the same way, down to the weighed tolerance.
//
//   Steady. The highest peak may be moved by a little noise. With `steady` the first point is the middle of the plateau
//   with the highest mean (steady_point.h), and no later point lies on it. Candidates are weighed until no remaining
//   one can have 0.93 of the best score.
//
//   Ties. Symmetric meshes have several maxima that are equal up to rounding. Scores are equal if they
//   differ by less than 2^-20 of the field's maximum value. Among equal scores, the candidate with the
//   largest x, then y, then z, then the first one found is chosen. The others may be chosen later, if
//   planes have votes left for them.
//
//   Mirror. On a symmetric mesh a point and its mirror image are chosen for the same sight. With `mirror_axis`, planes
//   have no votes left for the mirror images of chosen points either. Of a steady first point and its mirror image,
//   the one that comes first among ties is chosen unless it has less than 0.93 of the other: halves seldom are the
//   same.
//
//   End. A chosen point has no votes left, so no point is chosen twice. The search ends if no candidate
//   has more votes than the field's error bound and 2^-20 of its maximum value.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/field/tangential_field.h"

namespace rimline {

/// inner_radius <= |p| <= outer_radius, in unit coordinates.
struct SearchDomain {
    double inner_radius = 0.0;
    double outer_radius = 3.0;

    /// The nearest point of the domain, up to rounding. For the center, the nearest point along +x.
    glm::dvec3 nearest(const glm::dvec3& point) const;
    bool contains(const glm::dvec3& point) const;
};

struct PointOfInterest {
    glm::dvec3 point;
    double votes;         ///< Votes that earlier points have not got.
    double weight = 1.0;  ///< For example, the visible ratio.
    double score() const noexcept { return votes * weight; }
};

/// Returns the weights of points, or bounds of them, each in [0, 1], in their order, for a choice after `chosen`
/// others. Receives many points at once, so that they can be rendered together.
using Weigh =
    std::function<std::vector<double>(std::span<const glm::dvec3> points, std::size_t chosen)>;

struct InterestOptions {
    std::uint32_t count = 1;          ///< Number of points.
    std::uint32_t lattice = 17;       ///< Samples along each axis, 2 to 1024.
    double tolerance = 1e-3;          ///< Tolerance of positions, in unit coordinates; not 0.
    std::uint32_t climbs = 8;         ///< Number of climbs, from the best samples; not 0.
    Weigh weigh;                      ///< Empty: all weights are 1.
    Weigh bound;                      ///< Upper bounds of weights; cheap. Empty: 1.
    double weighed_tolerance = 0.05;  ///< Tolerance of positions with weights; not 0.
    /// With weights, every `weighed_stride`-th lattice sample along each axis is a candidate; not 0.
    std::uint32_t weighed_stride = 1;
    std::uint32_t weigh_batch = 16;  ///< Maximum number of points per call of `weigh`; not 0.
    std::optional<int> mirror_axis;  ///< Of the mirror through the center that keeps the mesh.
    /// Of the first point, with weights, in a shell. Takes some hundred weights more.
    bool steady = false;
    bool weighs_all = false;  ///< For tests: weighs every candidate. The result is the same.
};

struct PointsOfInterest {
    std::vector<PointOfInterest> points;  ///< In the order of choice.
    std::uint64_t evaluations = 0;        ///< Evaluations of the field.
    std::uint64_t weighed = 0;            ///< Weighed candidates.
    std::uint64_t candidates = 0;         ///< Number of weighed candidates with `weighs_all`.
};

/// Returns fewer than `count` points if no plane has votes left. The result does not depend on the number
/// of threads. Throws what `weigh` throws, and Error{cancelled}.
PointsOfInterest find_points_of_interest(const TangentialField& field, const SearchDomain& domain,
                                         const InterestOptions& options, const LongCall& call = {});

/// Climbs to a peak of the field from `from`, at most `within` away from it: for the nodes of camera paths
/// (4.5.5). In unit coordinates. `from` is first moved into the domain.
PointOfInterest climb(const TangentialField& field, const SearchDomain& domain,
                      const glm::dvec3& from, double within, double tolerance = 1e-3);

}  // namespace rimline
