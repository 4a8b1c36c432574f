#pragma once

// Collects the lines of a view, and projects them.
//
// The silhouette that is given follows from the rounded planes of the mesh. Where a face is seen edge-on, its
// plane may say front and its corners back. Those faces are found by one comparison a face, and their edges
// become lines too; local_rule.h then takes out those that the corners say are no silhouette. So the
// silhouettes are those of the corners, exactly.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/line_options.h"

namespace rimline {

class LineCollection {
public:
    /// Sets lines, flats and picture_size of the frame. Throws Error{too_large} where they are 2^31 or more.
    void collect(std::span<const EdgeId> silhouette, const LineOptions& options, LineFrame& frame);

private:
    void add_edge(EdgeId edge, LineKind kind, bool is_drawn, LineFrame& frame);
    void find_creases(float angle_rad, const LineGeometry& surface);
    void add_edges_of_doubtful_faces(const LineOptions& options, LineFrame& frame);
    void project(LineFrame& frame) const;

    std::vector<std::uint32_t> stamps_;  // By edge: the frame in which it became a line.
    std::uint32_t frame_number_ = 0;
    std::vector<std::uint32_t> doubtful_;
    std::vector<EdgeId> creases_;
    float creases_angle_rad_ = -1.0f;  // Of creases_; -1 before the first view.
};

}  // namespace rimline
