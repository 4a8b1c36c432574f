#pragma once

// The lines of a caller (PictureLines) as the segments that picture_line.vert draws.

#include <cstdint>
#include <vector>

#include "engine/picture_lines.h"
#include "shaders/layout.h"

namespace rimline {

/// Appends the segments of the lines of one color (PictureLine::color) that reach into the picture, cut at its
/// borders widened by the lines' width. Hidden lines are left out if frame.hidden_strength is 0. O(points).
void add_line_segments(const PictureLines& lines, std::uint32_t color, const gpu::FrameData& frame,
                       std::vector<gpu::LineSegment>& segments);

}  // namespace rimline
