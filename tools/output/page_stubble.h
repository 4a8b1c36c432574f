#pragma once

// Short hidden lines on a page that lead nowhere.
//
// They come and go with the tessellation of the mesh, as the stubble of visible strokes does
// (silhouette/lines/line_stubble.h). What a pen would draw of hidden shapes ends at other lines.

#include <cstddef>
#include <vector>

#include "tools/output/page_line.h"

namespace rimline::tools {

/// Takes out of lines[first], lines[first + 1], ... the hidden ones shorter than `stubble_mm` for each of their ends that
/// no other line is within `reach_mm` > 0 of, until there are none. Closed silhouettes count as having one such end;
/// other closed lines stay: they may be holes. No line has curves. O(points + pairs of ends and segments that are
/// near), a few times.
void leave_out_hidden_stubble(std::vector<PageLine>& lines, std::size_t first, double stubble_mm,
                              double reach_mm);

}  // namespace rimline::tools
