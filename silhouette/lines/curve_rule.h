#pragma once

// The local rule (local_rule.h) for segments of intersections: how many faces at a node cover the segment there
// and lie in front of it.
//
// The faces that contain all of a segment are its own, and do not count. Another face at a node often shares an
// edge with one of its own; then a corner of that own face stands for the segment's way, and the sign is exact.
// Other signs are those of doubles. Where they do not decide, the segment is doubtful, and rays decide it
// (invisibility.h).

#include <stop_token>

#include "silhouette/lines/line_frame.h"

namespace rimline {

/// Sets locals of the segments of intersections, and is_doubtful. O(segments · faces of a node · their
/// logarithm). Throws Error{cancelled}.
void find_curve_locals(LineFrame& frame, const std::stop_token& stop = {});

}  // namespace rimline
