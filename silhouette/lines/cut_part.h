#pragma once

// Parts of strokes that are cut.

#include "silhouette/lines/line_drawing.h"

namespace rimline {

/// Cuts off what lies before `begin` and behind `end` of a part, which are numbers of its points, in the order of the
/// run, each with the share of the way to the next. Adds the points of the rest to the drawing. Returns its length.
double cut_part(double begin, double end, bool is_orthographic, StrokePart& part,
                LineDrawing& drawing);

}  // namespace rimline
