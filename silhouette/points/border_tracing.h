#pragma once

// Which gaps are borders of the surface.
//
// One point cannot tell: a hole of the sampling looks like the end of the surface. But a border is a closed
// curve. From each of its points it goes on to the two that end the gap, and they lead back. Chains of
// such points are found, mended, and kept where they close (thesis 5.2.5, taken globally):
//
//   gaps        sectors whose excess (Stars::excess) is above gap_ratio; points with one are open.
//   round       an open point names the ends of its gap. A closed point that two open ones name, from
//               directions at least 70 degrees apart, opens between them (the thesis's first case). One,
//               closed or open, that is named by an open point which it does not name opens a sector beside
//               it whose excess is above 2, or whose angle is above 150 degrees. A triangle that stands
//               outside, on the line between two open points, is taken off where its angle at the closed
//               third, times 1 + 2 d / π for a deviation of d from what remains, is above 130 degrees and
//               the border bends less than 5.5 times as much through that third as past it (border_bend.h).
//               An open point whose gap ends one triangle short of the point that names it gives that
//               triangle up (the second case). Six rounds at most; each sees the state before it.
//   creases     an open point may have a second partial umbrella between the same ends, or its own may part
//               into two (supplement.h): there two smooth patches meet, and no surface ends. Runs of twelve
//               such points and more are creases, and so are 35% of a chain, 70% where it closes without
//               joints.
//   joints      noise breaks borders. Two ends of such chains, one in the other's star, are joined where they
//               run on in each other by turns of 40 degrees at most.
//   verdict     points that name each other are one chain. A chain is a border where at most a tenth of
//               its points are loose, linked to fewer than two others; from 5 points on. From 12 points on
//               it is one however many are loose, where four fifths open by more than 150 degrees. Points
//               that stand back from their border are taken off it last.
//
// Sampled surfaces without borders have hundreds of gaps, narrow ones, in chains of a few points with two
// loose ends; real borders have few of either (docs/points.md).

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/points/star_choice.h"

namespace rimline {

struct OpenPoint {
    enum class Verdict : std::uint8_t { border, crease, none };
    std::uint32_t point;
    Fan fan;         ///< With its gaps; of a crease, the umbrella of one side.
    Fan supplement;  ///< Of a crease, the other umbrella; else none.
    Verdict verdict = Verdict::none;
};

/// By point. Others have no gap.
std::vector<OpenPoint> trace_borders(std::span<const glm::dvec3> points,
                                     const NeighborLists& neighbors, const Stars& stars,
                                     double gap_ratio, const LongCall& call);

}  // namespace rimline
