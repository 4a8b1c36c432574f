#pragma once

// The lines of a drawing as polylines on a page, which all formats of drawings write.
//
// A visible line is a stroke. A hidden line is what follows each other of a chain's hidden runs. Where lines have
// colors of materials, each is a part of these of one color. Coordinates are
// whole thousandths of a mm, as the files have them.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "silhouette/lines/curve_fit.h"
#include "silhouette/lines/line_drawing.h"
#include "silhouette/mesh/mesh.h"
#include "tools/output/drawing_page.h"
#include "tools/output/line_materials.h"

namespace rimline::tools {

struct PageLine {
    LineKind kind;  ///< Of a stroke of several kinds, that of its greatest length.
    bool is_hidden;
    bool is_closed;  ///< The last point goes on to the first.
    std::vector<glm::dvec2>
        points;  ///< In mm, y downwards. At least two, and no two equal ones in a row.
    /// If not empty, curves in place of the points from points[0] on, and back to it if closed.
    std::vector<CurvePiece> curves;
    std::vector<std::uint32_t> chains;
    /// As pairs of the file's vertices, in the order of the line. Empty unless asked for.
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::uint32_t ink = k_no_material_ink;  ///< Index in MaterialInks::colors.

    double length_mm() const;
};

/// To whole thousandths of a mm.
glm::dvec2 rounded_to_um(const glm::dvec2& mm);

/// A rectangle in picture coordinates.
struct PictureRectangle {
    glm::dvec2 low, high;
};

struct PageLineOptions {
    std::uint32_t hidden_by = 0xffffffffu;  ///< Hidden runs with more faces in front are left out.
    double min_length_mm = 0.0;             ///< Shorter hidden lines are left out.
    /// Points are left out where the line moves by at most this. For drawings whose runs have all points.
    double simplify_mm = 0.0;
    /// Greater than 0: hidden lines that run beside others, this near, are left out (hidden_doubles.h).
    double double_mm = 0.0;
    double curve_mm = 0.0;  ///< Greater than 0: curves that leave the points by at most this.
    std::optional<PictureRectangle> frame;  ///< Lines end at its borders.
    const Mesh* mesh = nullptr;             ///< If set, PageLine::edges is.
    /// If set, PageLine::ink is: of what is seen from `point`. For drawings whose runs have all points.
    const LineMaterials* materials = nullptr;
    HomogeneousPoint point = {};
};

/// Appends the lines of the drawing.
void add_page_lines(const LineDrawing& drawing, const ViewPlace& place,
                    const PageLineOptions& options, std::vector<PageLine>& lines);

}  // namespace rimline::tools
