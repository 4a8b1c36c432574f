#pragma once

// The pieces of a line drawing: stretches of edges between the places where lines cross in the picture. The
// visibility of a piece is that of any of its points, so one ray for each piece can decide it.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

struct LinePiece {
    glm::dvec3 middle;
    std::array<VertexId, 2> vertices;  ///< Of its edge.
    double length;                     ///< In the picture.
    bool is_hidden;                    ///< In the drawing.
};

/// `drawing` was made with checkable() options (line_oracle.h). Intersections of faces have no pieces.
std::vector<LinePiece> pieces_of(const Mesh& mesh, const LineDrawing& drawing);

/// Lengths in the picture.
struct DifferingLength {
    double all = 0.0;
    double differing = 0.0;  ///< Of it, where an answer differs from the drawing.
};
/// `is_hidden` has one answer for each piece: 1 for hidden.
DifferingLength differing_length(std::span<const LinePiece> pieces,
                                 std::span<const std::uint8_t> is_hidden);

}  // namespace rimline::tools
