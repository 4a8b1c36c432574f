#pragma once

// Stubble: short strokes that come and go with the tessellation of the mesh, which a pen would not draw.
//
// A stroke shorter than LineOptions::stubble is left out in two cases:
//   - all of it lies within LineOptions::gap of a longer stroke: a hook where a line ends beside another;
//   - its edges bend by less than the noise around them, less than three times as much as the other edges of their
//     faces on average, and it does not lead from one stroke to another. On a machine part the faces beside a
//     crease are flat, on a scan they bend everywhere.
// A stroke of creases alone counts as short up to four times that length, and as noise up to six times as much.

#include <cstdint>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_geometry.h"
#include "silhouette/lines/line_options.h"
#include "silhouette/lines/picture_grid.h"

namespace rimline {

class LineStubble {
public:
    /// Takes strokes out of the drawing. O(strokes' points + pairs of points and segments that share a cell).
    void remove(const LineGeometry& surface, const LineOptions& options, LineDrawing& drawing);

private:
    // A segment of a stroke.
    struct Segment {
        glm::dvec2 from, to;
        std::uint32_t stroke;
    };
    void fill_grid(double gap, const LineDrawing& drawing);
    /// Whether one of these strokes has a place within `gap` of p: is_other(stroke) says which.
    template <typename IsOther>
    bool is_near_another(const glm::dvec2& p, double gap, IsOther&& is_other) const;
    bool leads_on(std::uint32_t stroke, double gap, const LineDrawing& drawing) const;
    bool lies_beside_longer(std::uint32_t stroke, double gap, const LineDrawing& drawing) const;

    PictureGrid grid_;
    std::vector<Segment> segments_;
};

}  // namespace rimline
