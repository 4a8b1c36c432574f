#pragma once

// Makes chains and runs of the lines of a view.
//
// A chain follows lines from link to link (line_links.h), and its runs end where visibility changes. Hidden runs
// between visible ones that are too short to see are then visible, and visible ones between hidden ones hidden.

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/lines/coincident_lines.h"
#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/line_links.h"
#include "silhouette/lines/line_options.h"
#include "silhouette/lines/smooth_contour.h"

namespace rimline {

class LineChains {
public:
    /// Sets points, sources, runs and chains of the drawing. Covered stretches are left out. O(lines + events),
    /// and as LineLinks::find(). Throws Error{cancelled}.
    void make(const LineFrame& frame, const CoveredStretches& covered, const LineOptions& options,
              LineDrawing& drawing, const std::stop_token& stop = {});

    /// The chain of each line of the frame, or k_no_chain. Valid until the next call of make().
    std::span<const std::uint32_t> chain_of_line() const noexcept { return chain_of_line_; }

private:
    // A point of a chain, and what follows it.
    struct ChainPoint {
        LinePoint point;
        LineSource source;
        std::int32_t count;  // Invisibility up to the next point.
        bool is_covered;     // Up to the next point: drawn by another line.
        bool ends_line;      // The next point is the first of the next line, at the same place.
        glm::dvec2 shift;    // Of LineOptions::smooth.
    };
    // Points [first, last] of a chain.
    struct Piece {
        std::uint32_t first, last;
        std::int32_t count;
        bool is_covered;
        double length;
    };

    void follow(const LineFrame& frame, LineEnd first_end, bool is_closed,
                const CoveredStretches& covered, const LineOptions& options, LineDrawing& drawing);
    void add_line(const LineFrame& frame, LineEnd entered_at,
                  const std::array<glm::dvec2, 2>& shifts, const CoveredStretches& covered);
    static bool is_seen(const LineFrame& frame, std::uint32_t line);
    glm::dvec2 shift_at(const LineFrame& frame, LineEnd end);
    void move_to_contour(double tolerance, bool is_closed);
    void split(bool is_closed, const LineOptions& options);
    void rotate_to_change(const LineOptions& options);
    // Of visibility, or of counts. False if there is none.
    bool rotate_to_change_of(bool counts);
    void bridge(bool is_closed, double gap);
    void add_chain(LineKind kind, bool is_closed, const LineOptions& options, LineDrawing& drawing);

    LineLinks links_;
    std::vector<std::uint8_t> is_done_;
    std::vector<std::uint32_t> chain_of_line_, lines_;  // lines_: of the chain that is being made.
    SmoothNormals normals_;
    SmoothContour contour_;
    std::uint32_t last_node_ = k_no_vertex;  // Where the line before ended, and its shift there.
    glm::dvec2 last_shift_{0.0};
    bool is_smooth_ = false;
    std::vector<ChainPoint> points_, rotated_;
    std::vector<double> shares_of_shift_;
    std::vector<Piece> pieces_;
    std::vector<LinePoint> piece_points_;
    std::vector<LineSource> piece_sources_;
    std::vector<std::uint32_t> kept_;  // Of these points.
};

}  // namespace rimline
