#pragma once

// Points of interest (thesis 4.2): where a field peaks in a ball or shell around the mesh, one after the
// other, each counting only the votes that those before it have not had (discounted_field.h).
//
// The domain is sampled on a lattice. From the best samples that are greater than their neighbors, a
// pattern of 27 points climbs to the peak, halving its width whenever its middle is the best, down to the
// tolerance (without weights only the best two, once all have come down to an eighth). Lattice samples
// and peaks are the candidates; the best is the point.
//
//   Weights. A candidate's score is its votes times a weight in [0, 1] (4.5.3: how much of the silhouette
//   is visible) that may be dear to find. As votes bound scores, candidates are weighed in falling order
//   of votes until none that is left can win. Where weights vary slowly, a part of the lattice's samples
//   will do beside the peaks (weighed_stride). Around the winner, patterns of 7 points are weighed the same
//   way, down to the weighed tolerance.
//
//   Ties. Symmetric meshes have several equal maxima, but for rounding. Scores that differ by less than
//   2^-20 of the field's greatest value count as equal, and of equal ones stands the one with the greatest
//   x, then y, then z, then the one found first. The others come later, if planes have votes left for them.
//
//   The end. A chosen point has no votes left, so none comes twice. Where no candidate has more votes than
//   the field's error bound (and 2^-20 of its greatest value), there are no more points.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/field/tangential_field.h"

namespace rimline {

/// inner_radius <= |p| <= outer_radius, in unit coordinates.
struct SearchDomain {
    double inner_radius = 0.0;
    double outer_radius = 3.0;

    /// The nearest point of the domain, but for rounding; from the center, the one along +x.
    glm::dvec3 nearest(const glm::dvec3& point) const;
    bool contains(const glm::dvec3& point) const;
};

struct PointOfInterest {
    glm::dvec3 point;
    double votes;         ///< Those that earlier points have not had.
    double weight = 1.0;  ///< The visible ratio, say.
    double score() const noexcept { return votes * weight; }
};

/// Weights of candidates, each in [0, 1], in the order of the points: many at once, so that they can be
/// drawn together.
using Weigh = std::function<std::vector<double>(std::span<const glm::dvec3>)>;

struct InterestOptions {
    std::uint32_t count = 1;          ///< How many points.
    std::uint32_t lattice = 17;       ///< Samples along an axis, 2 or more.
    double tolerance = 1e-3;          ///< Of positions, unit coordinates.
    std::uint32_t climbs = 8;         ///< From so many of the best samples.
    Weigh weigh;                      ///< Empty: all weights are 1.
    double weighed_tolerance = 0.05;  ///< Of positions, where they are weighed.
    /// Of the lattice's samples, every so-manieth along each axis is a candidate where they are weighed.
    std::uint32_t weighed_stride = 1;
    std::uint32_t weigh_batch = 16;  ///< At most so many at once.
    bool weighs_all = false;         ///< For tests: every candidate, for the same result.
};

struct PointsOfInterest {
    std::vector<PointOfInterest> points;  ///< In the order they were chosen.
    std::uint64_t evaluations = 0;        ///< Of the field.
    std::uint64_t weighed = 0;            ///< Candidates.
    std::uint64_t candidates = 0;         ///< What weighing all would have weighed.
};

/// Fewer than count where no plane has votes left. The same for any number of threads. Throws what weigh
/// throws, and Error{cancelled}.
PointsOfInterest find_points_of_interest(const TangentialField& field, const SearchDomain& domain,
                                         const InterestOptions& options, const LongCall& call = {});

/// The peak that is reached from a point within a distance of it, by the field's own votes: for the nodes
/// of camera paths (4.5.5). Unit coordinates; `from` is moved into the domain first.
PointOfInterest climb(const TangentialField& field, const SearchDomain& domain,
                      const glm::dvec3& from, double within, double tolerance = 1e-3);

}  // namespace rimline
