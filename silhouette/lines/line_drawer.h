#pragma once

// Draws the lines of a mesh from a camera, with exact visibility.
//
// The invisibility of a point of a line is the number of faces strictly between the eye and the point (Appel,
// The Notion of Quantitative Invisibility and the Machine Rendering of Solids, 1967). line_frame.h says how it
// is found. Lines then become chains (line_chains.h), and their visible runs strokes.

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "silhouette/error.h"
#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/lines/line_view.h"

namespace rimline {

/// Lengths are in picture coordinates (line_view.h).
struct LineOptions {
    /// By LineKind, which lines are drawn. All lines hide others, drawn or not.
    std::array<bool, k_line_kinds> draws{true, true, true, true};
    float crease_angle_rad = 0.7f;  ///< Creases bend by at least this angle.
    /// Hidden runs between visible ones are visible up to this length, and visible runs that end nearer to each
    /// other than this and go on in one direction are one stroke.
    double gap = 0.0;
    double min_length = 0.0;  ///< Shorter chains are left out.
    double simplify = 0.0;    ///< Points are left out where the line moves by at most this.
    /// Runs end where LineRun::hidden_by changes, not only where visibility does.
    bool splits_counts = false;
    bool keeps_coincident =
        false;  ///< Lines that coincide in the picture are drawn more than once.
};

class LineDrawer {
public:
    /// `surface` must outlive the drawer. One thread at a time.
    explicit LineDrawer(const LineSurface& surface);
    ~LineDrawer();
    LineDrawer(LineDrawer&&) noexcept;
    LineDrawer& operator=(LineDrawer&&) noexcept;

    /// `silhouette`: the silhouette from view.point(), by a tracker, an octree or brute force, in any order.
    /// The drawing is valid until the next call. O(lines · degree + crossings + components · log faces + faces):
    /// the last is one comparison a face. Memory is kept for the next call. Throws Error{cancelled}.
    const LineDrawing& draw(const LineView& view, std::span<const EdgeId> silhouette,
                            const LineOptions& options = {}, const LongCall& call = {});

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rimline
