#pragma once

// Checks a line drawing against a count of faces, in long double: the second opinion on visibility. It shares
// nothing with the drawing's own code but the mesh, the view and the drawing.
//
// Each line is sampled along its length. Before each sample the faces that the ray to the view's point meets are
// counted, one by one. Where a face or its border lies so near to the ray or the sample that long double cannot
// tell, the sample is undecided. Besides, every silhouette and border before the eye must be drawn over its whole
// length, and no edge over more than that.

#include <cstdint>
#include <string>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_options.h"
#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct LineCheck {
    std::uint64_t samples = 0;
    std::uint64_t undecided = 0;  ///< Of these, those that long double cannot decide.
    std::uint64_t wrong = 0;  ///< Of these, those with another number of faces in front of them.
    std::uint64_t wrong_visibility =
        0;  ///< Of these, those visible in the drawing and hidden, or reversed.
    std::uint64_t missing_edges = 0;   ///< Edges that are not drawn over their whole length.
    std::uint64_t repeated_edges = 0;  ///< Edges that are drawn over more than that.
    std::string first_difference;      ///< Names the first wrong sample, else edge; else empty.
};

/// Options for a drawing that can be checked: every line over its whole length, with its exact count.
LineOptions checkable(LineOptions options);

/// `drawing` was made with checkable() options, with silhouettes and borders among the drawn kinds. A sample is
/// taken every `spacing` of the picture, and at least one for each piece of a line. O(samples · faces at a place
/// of the picture) on all threads of oneTBB. Throws Error{cancelled}.
LineCheck check_lines(const Mesh& mesh, const LineView& view, const LineDrawing& drawing,
                      double spacing, const LongCall& call = {});

}  // namespace rimline
