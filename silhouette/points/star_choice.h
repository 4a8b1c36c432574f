#pragma once

// For each point the plane, and the star about it, that explain its neighbors best.
//
// No single estimate of the normal is right everywhere: the plane of the Gabriel triangle, which the
// thesis takes, errs by 26 degrees and more at 1% of the points of real models, the fitted plane at
// creases and where another sheet is near; and with a wrong normal everything after it is lost. So stars
// are made about several planes, fitted to all of the k nearest, to 8 and to 5, and the one that costs
// least is kept; then, where there is one that is not clean, about the normals of its nearest neighbors'
// stars too, in two rounds. Nine points of ten are clean at once. Last, again in two rounds, stars whose
// normal lies more than 60 degrees from those of all but one of their ring's points, which take two sheets
// for one, give way to whole ones that cost less, this angle counted.
//
// Cost: the mean deviation of its triangles from its normal, in radians, and 1 for each gap, or for each π
// that is open where that is more: one thin triangle, all else open, would be perfect otherwise.

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/points/fan.h"
#include "silhouette/points/neighborhood.h"

namespace rimline {

struct Stars {
    std::vector<Fan>
        fans;  ///< Of each point; gaps are its sectors of π and more. None: no umbrella.
    std::vector<glm::dvec3> normals;
    std::vector<double> scales;  ///< Neighborhood::scale of the star as it was chosen.
    std::vector<UndecidedReason> reasons;
    std::vector<std::uint8_t> is_clean;  ///< By its own scale alone no sector of it is a gap.

    /// The greatest of the scales of a sector's three corners.
    double scale_of(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                    std::size_t sector) const {
        return std::max({scales[point], scales[around.number(fan.ring[sector])],
                         scales[around.number(fan.ring[fan.next(sector)])]});
    }
    /// How little a triangle looks like surface: its circumradius as a multiple of the greatest of its
    /// corners' scales, times 1 + 2 d / π for a deviation of d from the star's normal; infinite for a gap,
    /// and beyond 85 degrees. Symmetric in the corners but for d, so neighbors mostly agree on it.
    double excess(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                  std::size_t sector) const;
};

Stars choose_stars(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                   double gap_ratio, const LongCall& call);

}  // namespace rimline
