#pragma once

// How a mesh's vertices move: by a wave that the GPU computes, or to positions that the caller brings.
// Triangles and edges stay as they are. Everything is in the mesh's own coordinates.

#include <glm/vec3.hpp>
#include <span>
#include <variant>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Every vertex moves along `direction`, by an amount that depends on how far along `travel` it is:
///
///     position = rest + amplitude * direction * sin(2 pi (travel · (rest - center) / length - turns))
///
/// With `travel` perpendicular to `direction` this shears space, which neither folds it nor turns
/// anything inside out, whatever the amplitude.
struct Wave {
    glm::dvec3 center{0.0};
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< Of length 1.
    glm::dvec3 travel{1.0, 0.0, 0.0};     ///< Of length 1.
    double amplitude = 0.1;
    double length = 1.0;  ///< Over 0.
    double turns = 0.0;   ///< How many lengths the wave has run.
};

/// Positions made elsewhere, one for each vertex of the mesh in its order (Mesh::positions()), all within
/// `radius` of `center`. They are copied when the frame is recorded.
struct MovedPositions {
    std::span<const glm::vec3> positions;
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

using Deformation = std::variant<Wave, MovedPositions>;

struct BoundingSphere {
    glm::dvec3 center;
    double radius;
};

/// Holds every vertex of the mesh, deformed. O(1).
BoundingSphere bounding_sphere(const Mesh& mesh, const Deformation& deformation);

/// A wave that suits a mesh: along `up`, running across it once in a bit less than its width, a tenth
/// of its radius high.
Wave default_wave(const Mesh& mesh, const glm::dvec3& up, double turns);

}  // namespace rimline
