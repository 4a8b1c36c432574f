#pragma once

// The order in which a pen draws lines.

#include <vector>

#include "tools/output/page_line.h"

namespace rimline::tools {

/// Puts the lines in an order in which a pen goes little ways between them, and turns lines around for that: those of one
/// layer, kind and ink together, each time the line with the nearest end, from the left upper corner of the page on.
/// Shorter by three to nine times than the order of the drawing. The lines stay the same. About O(lines), never more
/// than O(lines^2).
void order_for_pen(std::vector<PageLine>& lines);

}  // namespace rimline::tools
