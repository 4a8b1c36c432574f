#pragma once

// The pieces of a point's disc where the surface is not flat around it: one for each face that meets there,
// in the plane of the face, and cut where the other faces begin. At a border: one piece, cut at the gap.

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline {

struct DiscPiece {
    glm::dvec3 normal;  ///< Of length 1, or zero without an umbrella.
    /// Vectors into the piece: the half of the plane opposite to each is cut away. Zero: no cut.
    std::array<glm::dvec3, 3> cuts{};
};

/// One piece if the normals of the point's triangles differ by less than about 25 degrees, else two, or three
/// if two pieces leave a triangle that differs from both by more. A corner of more than three faces is drawn
/// with three. The pieces of a border point end at its gaps, as far as they have cuts left; a single piece with
/// one gap if that is of more than 135 degrees.
std::vector<DiscPiece> disc_pieces(const PointSurface& surface, PointId point);

}  // namespace rimline
