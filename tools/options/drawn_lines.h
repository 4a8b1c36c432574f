#pragma once

// Which lines `draw` draws, and how. Lengths are in mm on the page.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "silhouette/lines/line_drawer.h"
#include "tools/cli_classes.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

struct DrawnLines {
    std::array<bool, k_line_kinds> kinds{true, true, true, true};  ///< By LineKind.
    /// Not set: creases that bend by k_clear_crease_degrees and stand out (clear_creases.h).
    std::optional<double> crease_degrees;
    static constexpr double k_clear_crease_degrees = 30.0;
    std::string hidden = "none";  ///< Or dashed, or layer.
    std::uint32_t hidden_by = 0;  ///< 0: any number of faces.
    double gap_mm = 0.5;
    /// Not set: no visible line is left out, and hidden ones below k_min_hidden_mm.
    std::optional<double> min_length_mm;
    static constexpr double k_min_hidden_mm = 1.0;
    /// Not set: 4 mm, and in small drawings less (k_stubble_share).
    std::optional<double> stubble_mm;
    static constexpr double k_stubble_mm = 4.0, k_stubble_share = 1.0 / 48.0;
    double smooth_mm = 0.15;  ///< Less than half the width of a line.
    double simplify_mm = 0.02;
    double curve_mm = 0.05;
    double width_mm = 0.35;
    double hidden_width_mm = 0.18;
    bool keeps_coincident = false;
    std::optional<Color> color;        ///< Not set: black.
    bool has_material_colors = false;  ///< Shades of the materials of faces.

    const CLI::Option *curve_option = nullptr, *width_option = nullptr,
                      *hidden_width_option = nullptr;  ///< Set by add_to().

    void add_to(CLI::App& app);
    /// Throws UsageError for options without an effect. `has_curves`: of the format of the drawing.
    void check_usage(bool has_curves) const;
    /// PageLineOptions::double_mm. What is not drawn need not be looked at.
    double double_mm() const { return keeps_coincident || !draws_hidden() ? 0.0 : gap_mm; }
    /// PageLineOptions::visible_double_mm: a tenth of a fine pen.
    double visible_double_mm() const { return keeps_coincident ? 0.0 : 0.03; }
    bool draws_hidden() const { return hidden != "none"; }
    /// `stubble_mm` or its default in a drawing whose longer side is `side_mm`.
    double stubble_mm_of(double side_mm) const {
        return stubble_mm.value_or(std::min(k_stubble_mm, k_stubble_share * side_mm));
    }
    /// `mm_per_unit` of picture coordinates, and the longer side of the drawing.
    LineOptions line_options(double mm_per_unit,
                             double side_mm = std::numeric_limits<double>::infinity()) const;
};

}  // namespace rimline::tools
