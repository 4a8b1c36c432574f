#include "tools/options/drawn_lines.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <glm/trigonometric.hpp>
#include <vector>

#include "tools/command.h"
#include "tools/options/line_kind_names.h"
#include "tools/options/name_list.h"

namespace rimline::tools {

void DrawnLines::add_to(CLI::App& app) {
    constexpr const char* k_group = "Lines";
    add_name_list(
        app, "--lines", k_line_kind_names,
        [this](const std::vector<std::size_t>& numbers) {
            kinds.fill(false);
            for (const std::size_t n : numbers) kinds[n] = true;
        },
        "Draw these kinds of lines (default: all):")
        ->group(k_group);
    add_number(
        app, "--crease", crease_degrees, 1.0, 180.0,
        "Draw all edges that bend by at least this angle in degrees as creases (default: those "
        "that bend by 30 and stand out)")
        ->group(k_group);
    app.add_option(
           "--hidden", hidden,
           "Hidden lines: none, dashed, or in a layer of their own, as solid gray lines. Of "
           "those that run beside others within --gap, one is drawn")
        ->check(CLI::IsMember({"none", "dashed", "layer"}))
        ->capture_default_str()
        ->group(k_group);
    add_count(app, "--hidden-by", hidden_by, 1, 1'000'000,
              "Draw only hidden lines with at most N faces in front of them (default: any number)")
        ->default_str("")
        ->group(k_group);
    add_number(
        app, "--gap", gap_mm, 0.0, 100.0,
        "Join lines over gaps up to this length, hidden or beside a line that ends, and where one "
        "begins beside another's end, no farther from it than this")
        ->group(k_group);
    add_number(app, "--min-length", min_length_mm, 0.0, 1000.0,
               "Leave out shorter lines (default: 1 for hidden lines, 0 for visible ones)")
        ->group(k_group);
    add_number(
        app, "--stubble", stubble_mm, 0.0, 1000.0,
        "Leave out lines that a pen would not draw: those shorter than this that begin or end away "
        "from others, those shorter than twice this that do both, and of visible ones those "
        "shorter than six times this within --gap of others. The outline stays (default: 4, in "
        "drawings below "
        "192 mm a 48th of their longer side)")
        ->group(k_group);
    add_number(app, "--smooth", smooth_mm, 0.0, 100.0,
               "Move silhouettes by at most this to the contour of the smooth surface; 0: the "
               "edges of the mesh")
        ->group(k_group);
    add_number(app, "--simplify", simplify_mm, 0.0, 100.0,
               "Leave out points where the line moves by at most this")
        ->group(k_group);
    curve_option =
        add_number(
            app, "--curve", curve_mm, 0.0, 100.0,
            "SVG, PDF: fit Bézier curves that leave the line by at most this; 0: straight pieces")
            ->group(k_group);
    width_option =
        add_number(app, "--width", width_mm, 0.001, 100.0, "SVG, PDF: width of visible lines")
            ->group(k_group);
    hidden_width_option =
        add_number(app, "--hidden-width", hidden_width_mm, 0.001, 100.0,
                   "Width of hidden lines; in DXF, of which their dashes are multiples")
            ->group(k_group);
    add_color_or(app, "--line-color", color, "material", has_material_colors,
                 "SVG, PDF: color of lines (default: black). material: a dark shade of the colors "
                 "of the model's file")
        ->group(k_group);
    app.add_flag("--keep-coincident", keeps_coincident,
                 "Draw all of several lines that coincide in the picture, not one, and all hidden "
                 "lines within --gap of others")
        ->group(k_group);
}

void DrawnLines::check_usage(bool has_curves) const {
    if (!draws_hidden() && hidden_by > 0)
        throw UsageError("--hidden-by: needs --hidden dashed or --hidden layer");
    if (!draws_hidden() && hidden_width_option->count() > 0)
        throw UsageError("--hidden-width: needs --hidden dashed or --hidden layer");
    if (!has_curves && curve_option->count() > 0 && curve_mm > 0.0)
        throw UsageError("--curve: only drawings in SVG and PDF have curves");
    if (!has_curves && (color || has_material_colors))
        throw UsageError("--line-color: only drawings in SVG and PDF have colors");
    if (!has_curves && width_option->count() > 0)
        throw UsageError("--width: only drawings in SVG and PDF have widths");
}

LineOptions DrawnLines::line_options(double mm_per_unit, double side_mm) const {
    return {.draws = kinds,
            .crease_angle_rad =
                static_cast<float>(glm::radians(crease_degrees.value_or(k_clear_crease_degrees))),
            .gap = gap_mm / mm_per_unit,
            .min_length = min_length_mm.value_or(0.0) / mm_per_unit,
            .stubble = stubble_mm_of(side_mm) / mm_per_unit,
            .smooth = smooth_mm / mm_per_unit,
            .shapes_hidden = draws_hidden(),
            .simplify = simplify_mm / mm_per_unit,
            .splits_counts = hidden_by > 0,
            .keeps_coincident = keeps_coincident};
}

}  // namespace rimline::tools
