#pragma once

// Draws the lines of a mesh from a camera, with exact visibility.
//
// The invisibility of a point of a line is the number of faces strictly between the eye and the point (Appel,
// The Notion of Quantitative Invisibility and the Machine Rendering of Solids, 1967). line_frame.h says how it
// is found. Lines then become chains (line_chains.h), and their visible runs strokes.

#include <memory>
#include <span>

#include "silhouette/error.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_options.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/lines/line_view.h"

namespace rimline {

class LineDrawer {
public:
    /// `surface` must outlive the drawer. One thread at a time.
    explicit LineDrawer(const LineSurface& surface);
    explicit LineDrawer(LineSurface&&) = delete;  // A temporary would dangle.
    ~LineDrawer();
    LineDrawer(LineDrawer&&) noexcept;
    LineDrawer& operator=(LineDrawer&&) noexcept;

    /// `silhouette`: the silhouette from view.point(), by a tracker, an octree or brute force, in any order.
    /// Lengths do not depend on the order; which chains lines form, and the order of these, may.
    /// The drawing is valid until the next call. Ids of chains are their indices. What is nearer to a perspective eye
    /// than 1e-5 radii of the mesh, in depth, is not drawn and hides nothing.
    /// O(lines · degree + crossings + components · log faces + faces): the last is one comparison a face.
    /// Memory is kept for the next call. Throws Error{cancelled}.
    const LineDrawing& draw(const LineView& view, std::span<const EdgeId> silhouette,
                            const LineOptions& options = {}, const LongCall& call = {});

    /// The next frame of a moving camera: the same drawing, but chains keep the ids of the frame before, which this
    /// drawer drew last (line_identity.h).
    /// `changes`: of the tracker of the silhouette, from the point of the frame before to view.point().
    /// After a call that threw, the next frame is one for draw().
    const LineDrawing& draw_next(const LineView& view, std::span<const EdgeId> silhouette,
                                 const ChangeSet& changes, const LineOptions& options = {},
                                 const LongCall& call = {});

private:
    const LineDrawing& draw(const LineView& view, std::span<const EdgeId> silhouette,
                            const ChangeSet* changes, const LineOptions& options,
                            const LongCall& call);
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rimline
