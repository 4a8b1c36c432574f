#pragma once

// Leaves points of a line out (Douglas, Peucker, 1973).

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/lines/line_drawing.h"

namespace rimline {

/// Sets `kept` to the numbers of the points that stay, ascending: the first, the last, and as many as it takes
/// that no point lies farther than `tolerance` from the line through those that stay. O(n log n) as a rule; no worse
/// where many points are as far as each other, as in a comb.
void simplify(std::span<const LinePoint> points, double tolerance,
              std::vector<std::uint32_t>& kept);

}  // namespace rimline
