#pragma once

// A line drawing as data. The JSON has for each view
//
//   points   [x, y, depth, arc] in picture coordinates (silhouette/lines/line_view.h), y upwards
//   sources  for each point [vertex, vertex, share] of its edge, as the file numbers them, or with --subdivide the
//            refined mesh; null on an intersection
//   runs     chain, points [first, last), hidden_by, length
//   chains   id, kind, runs [first, last), closed, length
//   strokes  parts [run, reversed], closed, length
//   page     the place on the page of (x, y) is origin_mm + mm_per_unit * (x, -y), from the upper left corner
//            frame_mm: [left, top, right, bottom] of the picture, if it shows only a part of the lines, else null. The
//            lines here are whole; the other formats end them at its borders.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/mesh/mesh.h"
#include "tools/output/drawing_page.h"
#include "tools/output/page_lines.h"

namespace rimline::tools {

nlohmann::ordered_json drawing_json(const LineDrawing& drawing, const Mesh& mesh,
                                    const ViewPlace& place,
                                    const std::optional<PictureRectangle>& frame);

}  // namespace rimline::tools
