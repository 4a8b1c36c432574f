#pragma once

// Repairs gaps by what neighbors see (thesis 5.2.5, both cases), so that borders become chains of points
// that name each other (border_gaps.h). One round does, for each point:
//
//   between     A closed point that two open points name, from directions at least 70 degrees apart, opens
//               between these two (the thesis's first case).
//   beside      A point, closed or open, that an open point names and that does not name it back opens one
//               of the two sectors beside the open point: the one with the greater excess where that is
//               above 2, else the one with the greater angle where that is above 150 degrees.
//   shortened   An open point whose gap ends one triangle short of the point that names it gives that
//               triangle up (the thesis's second case).
//   ear         A closed point e, of which a triangle has the edge between two open points, lies outside
//               this edge or is a point of the border. The triangle is taken off where its angle at e, times
//               1 + 2 d / π for a deviation of d from the remaining umbrella, is above 130 degrees and the
//               border bends less than 5.5 times as much through e as past it (border_bend.h).

#include "silhouette/points/border_gaps.h"

namespace rimline {

/// One round. Each point sees the others as they were before the round. Returns whether any point changed.
/// O(open points).
bool repair_gaps(BorderGaps& gaps);

}  // namespace rimline
