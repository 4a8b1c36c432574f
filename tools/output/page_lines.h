#pragma once

// The lines of a drawing as polylines on a page, which all formats of drawings write.
//
// A visible line is a stroke. A hidden line is what follows each other of a chain's hidden runs. Where lines have
// colors of materials, each is a part of these of one color. Coordinates are
// whole thousandths of a mm, as the files have them.

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/mesh/mesh.h"
#include "tools/options/drawn_lines.h"
#include "tools/options/line_camera.h"
#include "tools/output/drawing_page.h"
#include "tools/output/line_materials.h"
#include "tools/output/page_line.h"

namespace rimline::tools {

/// A rectangle in picture coordinates.
struct PictureRectangle {
    glm::dvec2 low, high;
};

/// A small part of a line's width.
constexpr double k_max_outside_mm = 0.05;

struct PageLineOptions {
    std::uint32_t hidden_by = 0xffffffffu;  ///< Hidden runs with more faces in front are left out.
    double min_length_mm = 0.0;             ///< Shorter hidden lines are left out.
    /// Points are left out where the line moves by at most this. For drawings whose runs have all points.
    double simplify_mm = 0.0;
    /// Greater than 0: hidden lines that run beside others, this near, are left out (page_doubles.h).
    double double_mm = 0.0;
    double visible_double_mm = 0.0;  ///< The same of visible lines, which are nearly one.
    double min_visible_mm = 0.0;     ///< What is left of them and shorter is left out.
    /// Greater than 0: curves that leave the points by at most this; by less where they would otherwise leave the frame
    /// or the page by more than k_max_outside_mm.
    double curve_mm = 0.0;
    /// Greater than 0: hidden lines that are this short and lead nowhere are left out (page_stubble.h). Ends are as near
    /// to other lines as double_mm.
    double hidden_stubble_mm = 0.0;
    std::optional<glm::dvec2> page_mm;      ///< The size of the page.
    std::optional<PictureRectangle> frame;  ///< Lines end at its borders.
    const Mesh* mesh = nullptr;             ///< If set, PageLine::edges is.
    /// If set, PageLine::ink is: of what is seen from `point`. For drawings whose runs have all points.
    const LineMaterials* materials = nullptr;
    HomogeneousPoint point = {};
};

/// Of what is drawn of a part of the picture, as curves, on a page of this size, at this scale.
PageLineOptions page_line_options(const DrawnLines& drawn, const ShownPart& part,
                                  const glm::dvec2& page_mm, double mm_per_unit);

/// Appends the lines of the drawing.
void add_page_lines(const LineDrawing& drawing, const ViewPlace& place,
                    const PageLineOptions& options, std::vector<PageLine>& lines);

}  // namespace rimline::tools
