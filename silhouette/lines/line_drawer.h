#pragma once

// Draws the lines of a mesh from a camera, with exact visibility.
//
// The invisibility of a point of a line is the number of faces strictly between the eye and the point (Appel,
// The Notion of Quantitative Invisibility and the Machine Rendering of Solids, 1967). line_frame.h says how it
// is found. Lines then become chains (line_chains.h), and their visible runs strokes.

#include <memory>
#include <span>

#include "silhouette/error.h"
#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_options.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/lines/line_view.h"

namespace rimline {

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
