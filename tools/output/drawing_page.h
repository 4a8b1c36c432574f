#pragma once

// Places pictures on a page: one, or the views of a drawing sheet.
//
// Views lie in the cells of a grid, with one scale, and each in the middle of its cell. A view from the front and
// one from above have the same width and one column, so they are aligned; so are views of one row.
//
// Places on the page are in mm, x to the right and y downwards, from the upper left corner.

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "tools/options/line_page.h"

namespace rimline::tools {

/// What a view shows, in picture coordinates, and its cell.
struct ViewCell {
    glm::dvec2 low, high;
    int column = 0;  ///< From the left.
    int row = 0;     ///< From above.
};

struct ViewPlace {
    glm::dvec2 origin_mm;  ///< The place of the picture coordinates (0, 0).
    double mm_per_unit;
    glm::dvec2 to_mm(const glm::dvec2& p) const noexcept {
        return {origin_mm.x + mm_per_unit * p.x, origin_mm.y - mm_per_unit * p.y};
    }
};

struct DrawingPage {
    glm::dvec2 size_mm;
    std::vector<ViewPlace> views;  ///< As the cells.
};

/// The longer side of a page that is as large as its drawing, where the scale is not set.
constexpr double k_fitted_page_mm = 180.0;

/// The distance between views is the margin, but at least 5 mm. Throws UsageError if the margins leave no
/// space, or if the drawing does not fit between them or on a page of k_max_page_mm, and Error{bad_input} if
/// all cells have no extent.
DrawingPage place_views(const LinePage& paper, std::span<const ViewCell> cells);

}  // namespace rimline::tools
