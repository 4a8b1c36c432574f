#pragma once

// Bézier curves through the points of a line (Schneider, An Algorithm for Automatically Digitizing Fitted Curves,
// Graphics Gems, 1990).
//
// The line is cut at its corners. Each part gets one cubic curve, fitted by least squares; where that leaves the
// line by more than the tolerance, it is cut in two with a common tangent. Straight pieces stay straight.

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace rimline {

/// A piece of a path from the end of the piece before it.
struct CurvePiece {
    bool is_straight;  ///< Then the control points have no meaning.
    glm::dvec2 control_1, control_2;
    glm::dvec2 end;
};

/// Pieces from points[0] to the last point, or back to points[0] if `is_closed`, in which case points[0] is not
/// repeated at the end. Curve and line are nowhere farther than `tolerance` from each other (as sampled eight times
/// between two points). Fewer than three points, or a tolerance of 0, give straight pieces. O(n log n) mostly.
std::vector<CurvePiece> fit_curves(std::span<const glm::dvec2> points, bool is_closed,
                                   double tolerance);

/// The place on a piece that begins at `begin`, at a parameter in [0, 1].
glm::dvec2 point_on(const CurvePiece& piece, const glm::dvec2& begin, double parameter);

}  // namespace rimline
