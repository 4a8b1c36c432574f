#pragma once

// Which lines are drawn, and what becomes of short gaps and short lines.

#include <array>
#include <cstdint>
#include <span>

#include "silhouette/lines/line_drawing.h"

namespace rimline {

/// Lengths are in picture coordinates (line_view.h), finite and not negative.
struct LineOptions {
    /// By LineKind, which lines are drawn. All lines hide others, drawn or not.
    std::array<bool, k_line_kinds> draws{true, true, true, true};
    float crease_angle_rad = 0.7f;  ///< Creases bend by at least this angle.
    /// If not empty, creases are drawn of those edges alone whose flag is not 0; one flag for each edge.
    std::span<const std::uint8_t> shown_creases{};
    /// Hidden runs between visible ones are visible up to this length, and visible runs that end nearer to each
    /// other than this and go on in one direction are one stroke. So are those of which one begins beside the other,
    /// no farther from it than this and at most six times this before its end; what runs beside it is left out. Visible
    /// runs stay, however short.
    double gap = 0.0;
    double min_length = 0.0;  ///< Shorter chains are left out.
    double stubble = 0.0;  ///< Shorter strokes are left out where they are noise (line_stubble.h).
    /// Silhouettes move by at most this to the contour of the smooth surface (smooth_contour.h).
    double smooth = 0.0;
    bool shapes_hidden =
        true;  ///< Hidden runs move too. False takes less time where they are not drawn.
    double simplify = 0.0;  ///< Points are left out where the line moves by at most this.
    /// Runs end where LineRun::hidden_by changes, not only where visibility does.
    bool splits_counts = false;
    /// Lines that coincide in the picture are drawn more than once. Those count as coinciding that are within what the
    /// shift of the eye (LineView::shift()) moves them: about four millionths of the mesh's radius.
    bool keeps_coincident = false;
};

}  // namespace rimline
