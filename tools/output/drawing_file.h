#pragma once

// Files of line drawings, in mm.
//
//   .svg   Inkscape layers `1 visible` and `2 hidden`, with a group for each kind of line
//   .pdf   one page, with the same layers
//   .dxf   R12, polylines in a layer for each kind (VISIBLE_SILHOUETTE, HIDDEN_BORDER, ...), y upwards
//   .json  points, runs, chains and strokes (drawing_json.h)

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/options/drawn_lines.h"
#include "tools/options/option_types.h"
#include "tools/output/page_line.h"

namespace rimline::tools {

enum class DrawingFormat { svg, pdf, dxf, json };

/// The format of the file name's ending, in upper or lower case. Nothing for other endings.
std::optional<DrawingFormat> drawing_format_of(const std::string& file_name);

/// Of hidden lines: a dash and the space after it, in widths of the line.
constexpr double k_dash_widths = 10.0, k_dash_space_widths = 5.0;
/// The gray of hidden lines that are not dashed.
constexpr std::uint8_t k_hidden_gray = 128;

struct PageDrawing {
    std::string title;
    glm::dvec2 size_mm;
    std::vector<PageLine> lines;
    double width_mm, hidden_width_mm;
    bool dashes_hidden;  ///< If not, hidden lines are gray.
    bool has_sources;    ///< SVG: paths have data-chain and data-edges.
    // SVG and PDF: of lines without an ink (layer_color()), and of those of each ink (PageLine::ink).
    Color color{0, 0, 0};
    std::vector<Color> inks = {};

    /// Of the lines of a layer that have no ink. Hidden lines that are not dashed are gray.
    Color layer_color(bool is_hidden) const {
        if (is_hidden && !dashes_hidden) return {k_hidden_gray, k_hidden_gray, k_hidden_gray};
        return color;
    }
};

/// Without lines yet, and without sources.
PageDrawing empty_drawing(const DrawnLines& drawn, std::string title, const glm::dvec2& size_mm);

// The contents of the files.
std::string drawing_svg(const PageDrawing& drawing);
std::string drawing_pdf(const PageDrawing& drawing);
std::string drawing_dxf(const PageDrawing& drawing);

/// Appends the number with a point, whatever the locale, at most this many decimals, and no zeros at its end.
void append_decimals(std::string& text, double value, int most_decimals = 3);

}  // namespace rimline::tools
