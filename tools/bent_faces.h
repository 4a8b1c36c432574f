#pragma once

// The faces that meet at a sharp point: the triangles of its umbrellas, gathered by their normals.

#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline::tools {

struct BentFace {
    glm::dvec3 normal;  ///< Of length 1; all faces of a point are turned the same way.
    glm::dvec3 middle;  ///< From the point into its triangles.
};

/// One face where no triangle turns from the first by more than 25 degrees, else two, or three where two
/// leave one that does; none without an umbrella.
std::vector<BentFace> bent_faces(const PointSurface& surface, PointId point);

}  // namespace rimline::tools
