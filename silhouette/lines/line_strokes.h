#pragma once

// Joins visible runs to strokes: runs whose ends lie near each other and that go on in one direction, as where a
// line passes behind another and a new one begins beside it; runs of which one begins beside the end of the other,
// as where a contour goes to and fro between the faces of a hollow; and two that meet in a corner alone, as where a
// part of an outline was left out because it coincides with another line.

#include <array>
#include <cstdint>
#include <limits>
#include <stop_token>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_options.h"

namespace rimline {

class LineStrokes {
public:
    /// Sets strokes and stroke_parts of the drawing, and adds points of parts that are not whole runs. Strokes shorter
    /// than options.min_length are left out. O(runs log runs + pairs of ends nearer than six times options.gap). Throws
    /// Error{cancelled}.
    void join(bool is_orthographic, const LineOptions& options, LineDrawing& drawing,
              const std::stop_token& stop = {});

private:
    static constexpr std::uint32_t k_no_end = 0xffffffffu;
    // End 2 * run is the first end of a run, 2 * run + 1 its last.
    struct RunEnd {
        std::uint32_t end;
        glm::dvec2 position;
        glm::dvec2 way;  // Out of the run, of length 1.
    };
    // Where a run is cut: at number + share of its points.
    struct Cut {
        std::uint32_t end = k_no_end;  // k_no_end: nowhere.
        double at = 0.0;
        double score = std::numeric_limits<double>::infinity();
    };
    struct Pair {
        double score;
        std::uint32_t a, b;  // Ends.
        // Of runs that overlap, one of which is made, the first if something is left of that run then.
        std::array<Cut, 2> cuts;
    };
    struct NearestPlace {
        double at;
        double distance;
    };
    void find_ends(double gap, const LineDrawing& drawing);
    void find_rows(double height);
    // Calls visit(k) for ends but i that are at most this far from it along x, and along y by less than two rows, until
    // it returns true. Returns whether it did.
    template <typename Visit>
    bool any_beside(std::size_t i, double reach, Visit&& visit) const;
    void find_pairs(double gap, const LineDrawing& drawing, const std::stop_token& stop);
    void add_pair(std::size_t i, std::size_t j, double gap, const LineDrawing& drawing);
    void add_overlap(const RunEnd& a, const RunEnd& b, double gap, const LineDrawing& drawing);
    static NearestPlace nearest_before(const RunEnd& end, const glm::dvec2& place, double reach,
                                       const LineDrawing& drawing);
    void mate(const Pair& pair, double gap, const LineDrawing& drawing);
    bool cut(const Cut& cut, double gap, const LineDrawing& drawing);
    bool is_corner(std::size_t i, std::size_t j, double gap) const;
    void follow(std::uint32_t first_end, bool is_closed, double min_length, LineDrawing& drawing);
    double add_part(std::uint32_t run, bool is_reversed, LineDrawing& drawing) const;

    bool is_orthographic_ = false;

    // A band of the picture along x, of the height that find_rows() was given or more.
    struct Row {
        double number;            // Of its place along y; rows without an end are left out.
        std::size_t first, last;  // Of row_ends_.
    };

    std::vector<RunEnd> ends_;  // By x.
    std::vector<Row> rows_;
    std::vector<std::size_t> row_ends_;  // The ends of each row, by x.
    std::vector<std::size_t> row_of_;    // Of each end, in rows_.
    std::vector<double> row_numbers_;    // Of each end.
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> mates_;           // By end.
    std::vector<double> cut_begins_, cut_ends_;  // By run, numbers of points with a share.
    std::vector<std::uint8_t> is_done_;
};

}  // namespace rimline
