#pragma once

// Which chains of open points are borders, and which are creases.
//
//   joints      Noise breaks borders. A loose end is a point linked to only one other. Two loose ends, one in
//               the star of the other, are joined where they continue each other by turns of 40 degrees at
//               most. The pairs with the least turns are joined first.
//   creases     An open point may have a second partial umbrella between the same ends, or its own may part
//               into two (supplement.h): there two smooth patches meet, and the surface does not end. Runs of
//               twelve such points and more are creases. So are chains with more than 35% of such points, or
//               more than 70% where the chain closes without joints.
//   borders     Points that are linked or joined are one chain. A chain of at least 5 points is a border
//               where at most a tenth of its points are loose: linked to fewer than two others. A chain of
//               at least 12 points is a border however many are loose, where four fifths of its points open
//               by more than 150 degrees.
//
// Sampled surfaces without borders have hundreds of gaps: narrow ones, in chains of a few points with two
// loose ends. Real borders have few of either (docs/results/points.md).

#include "silhouette/points/border_gaps.h"

namespace rimline {

/// Sets the verdict of all open points, and of creases both umbrellas. On all threads.
void judge_chains(BorderGaps& gaps, const CallPart& part);

}  // namespace rimline
