#pragma once

// Makes gaps consistent between neighbors (thesis 5.2.5, both cases), so that borders become chains of points
// that name each other (border_gaps.h). There are four repairs:
//
//   between     A closed point that two open points name, from directions at least 70 degrees apart, opens
//               between these two (the thesis's first case).
//   beside      An open point p names q, and q does not name p. Then q, closed or open, opens one of its two
//               sectors beside p: the one with the greater excess where that is above 2, else the one with
//               the greater angle where that is above 150 degrees.
//   shortened   In the same case, where the gap of an open q ends one triangle short of p, that triangle is
//               removed instead (the thesis's second case).
//   ear         A closed point e has a triangle on the edge between two open points. The
//               triangle is removed where its angle at e, times 1 + 2 d / π for a deviation of d from the
//               remaining umbrella, is above 130 degrees, and the border bends less than 5.5 times as much
//               through e as past it (border_bend.h).

#include "silhouette/points/border_gaps.h"

namespace rimline {

/// One round over all points. Reads the gaps as they were before it. Returns whether any point changed.
/// O(open points).
bool repair_gaps(BorderGaps& gaps);

}  // namespace rimline
