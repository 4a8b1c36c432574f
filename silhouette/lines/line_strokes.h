#pragma once

// Joins visible runs to strokes: runs whose ends lie near each other and that go on in one direction, as where a
// line passes behind another and a new one begins beside it; and two that meet in a corner alone, as where a part of
// an outline was left out because it coincides with another line.

#include <cstdint>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_options.h"

namespace rimline {

class LineStrokes {
public:
    /// Sets strokes and stroke_parts of the drawing. Strokes shorter than options.min_length are left out.
    /// O(runs log runs + pairs of ends nearer than options.gap).
    void join(const LineOptions& options, LineDrawing& drawing);

private:
    // End 2 * run is the first end of a run, 2 * run + 1 its last.
    struct RunEnd {
        std::uint32_t end;
        glm::dvec2 position;
        glm::dvec2 way;  // Out of the run, of length 1.
    };
    struct Pair {
        double score;
        std::uint32_t a, b;  // Ends.
    };
    void find_ends(double gap, const LineDrawing& drawing);
    void find_pairs(double gap, const LineDrawing& drawing);
    bool is_corner(std::size_t i, std::size_t j, double gap) const;
    void follow(std::uint32_t first_end, bool is_closed, double min_length, LineDrawing& drawing);

    std::vector<RunEnd> ends_;
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> mates_;  // By end.
    std::vector<std::uint8_t> is_done_;
};

}  // namespace rimline
