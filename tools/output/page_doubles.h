#pragma once

// Lines beside others on a page.
//
// Surfaces seen edge-on have many hidden lines within the width of a pen: their dashes would fill each other's spaces.
// Where lines are that near, a drawing shows the visible one, else the longest. Visible lines beside each other are
// what is seen; but where they are nearly the same line, as edges of a file whose coordinates have six digits are in a
// view along a face, a plotter would draw it twice, and a laser cut it.

#include <cstddef>
#include <vector>

#include "tools/output/page_line.h"

namespace rimline::tools {

/// Takes out of the hidden ones of lines[first], lines[first + 1], ... what runs beside a visible line, or beside what
/// stays of a longer hidden one, within `reach_mm` > 0 and in about its direction; and where a hidden one turns back on
/// itself, what runs beside an earlier part of it. Lines that only cross or meet others stay whole. What is left of a
/// line is one line or several, in its place, without those shorter than `min_length_mm`. No line has curves.
/// O(length / reach_mm), times the lines near to a place.
void leave_out_hidden_doubles(std::vector<PageLine>& lines, std::size_t first, double reach_mm,
                              double min_length_mm);

/// The same of visible lines, beside longer visible ones and beside themselves. What is left of a line and shorter than
/// six times the reach goes too.
void leave_out_visible_doubles(std::vector<PageLine>& lines, std::size_t first, double reach_mm,
                               double min_length_mm);

}  // namespace rimline::tools
