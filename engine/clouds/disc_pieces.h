#pragma once

// What a point's disc becomes where the surface is not flat around it: several discs, each in the plane of
// a face that meets there and cut where the others begin; at a border one, cut at the gap.

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline::tools {

struct DiscPiece {
    glm::dvec3 normal;  ///< Of length 1, or zero without an umbrella.
    /// What lies on the other side of the point than these is left out; zero: none.
    std::array<glm::dvec3, 2> cuts{};
};

/// One piece where no triangle turns from another by more than 25 degrees or so, else two, or three where
/// two leave a triangle that does: a corner of more faces is drawn as if it had three.
/// At a border whose gap is its only one and wider than 135 degrees, the piece ends at the gap.
std::vector<DiscPiece> disc_pieces(const PointSurface& surface, PointId point);

}  // namespace rimline::tools
