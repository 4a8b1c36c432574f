#pragma once

// Stubble: short lines that a pen would not draw. Silhouettes of scanned surfaces leave them beside longer lines.
//
//   loose   A short line with an end where no other line is; twice as long, if that is true of both ends. A short line between others, like the short edge of a
//           plate or a piece of an outline between two folds, stays: without it, there would be a gap.
//   double  A line that is not much longer, all of it beside longer ones, so near that it would only thicken them.

#include "engine/picture_lines.h"

namespace rimline::tools {

/// Lengths are in picture coordinates.
struct StubbleLimits {
    double min_length;    ///< Loose lines are shorter for each loose end.
    double reach;         ///< From an end of a line to another line.
    double double_reach;  ///< Between lines that look like one.
};

/// Removes stubble until there is none. Closed lines are removed where they are shorter than min_length. Hidden lines
/// hold hidden lines only. O(points) for each round mostly; there are few.
void remove_stubble(PictureLines& lines, const StubbleLimits& limits);

}  // namespace rimline::tools
