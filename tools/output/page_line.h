#pragma once

// One line of a drawing on a page.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "silhouette/lines/curve_fit.h"
#include "silhouette/lines/line_drawing.h"
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
    std::uint8_t ink = k_no_material_ink;  ///< Index in MaterialInks::colors.

    double length_mm() const;
};

/// To whole thousandths of a mm.
glm::dvec2 rounded_to_um(const glm::dvec2& mm);

}  // namespace rimline::tools
