#pragma once

// For each point the plane, and the star about it, that explain its neighbors best.
//
// No single estimate of the normal is right everywhere. The plane of the Gabriel triangle, which the thesis
// uses, errs by 26 degrees and more at 1% of the points of real models. The fitted plane errs at creases and
// near another sheet. With a wrong normal all later steps fail. So stars are made about several planes:
//
//   fit       Planes fitted to all of the k nearest, to 8 and to 5. The star with minimum cost is kept. Nine
//             points of ten are clean then.
//   improve   Where the star is not clean, also planes with the normals of the nearest neighbors' stars. Two
//             rounds.
//   repair    A star whose normal lies more than 60 degrees from those of all but one of its ring's points
//             takes two sheets for one. It is replaced by a whole star of lower cost, where this angle is
//             added to the cost. Two rounds.
//
// The cost of a star is the mean deviation of its triangles from its normal, in radians, plus 1 for each gap.
// Where its opening divided by π is greater than the number of gaps, it counts instead: else one thin
// triangle and a wide gap would be perfect.

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/points/fan.h"
#include "silhouette/points/neighborhood.h"

namespace rimline {

struct Stars {
    /// Of each point; gaps are its sectors of π and more. May have no triangle.
    std::vector<Fan> fans;
    std::vector<glm::dvec3> normals;
    std::vector<double> scales;  ///< Neighborhood::scale of the star as it was chosen.
    std::vector<UndecidedReason> reasons;
    std::vector<std::uint8_t> is_clean;  ///< By its own scale alone it has no gaps.

    /// The maximum of the scales of a sector's three corners.
    double scale_of(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                    std::size_t sector) const {
        return std::max({scales[point], scales[around.number(fan.ring[sector])],
                         scales[around.number(fan.ring[fan.next(sector)])]});
    }
    /// How unlikely it is that a triangle is part of the surface: its circumradius divided by the maximum of
    /// its corners' scales, times 1 + 2 d / π for a deviation of d from the star's normal. Infinite for a gap
    /// and where d is above 85 degrees. Symmetric in the corners except for d, so neighbors mostly agree.
    double excess(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                  std::size_t sector) const;
};

/// `points` and `neighbors` in the order of OrderedPoints. O(n) on all threads. Throws Error{cancelled}.
Stars choose_stars(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                   double gap_ratio, const LongCall& call);

}  // namespace rimline
