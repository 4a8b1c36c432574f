#pragma once

// How a mesh's vertices move: by a wave that the GPU computes, or to positions that the caller gives.
// Triangles and edges do not change. Everything is in the mesh's own coordinates.

#include <glm/vec3.hpp>
#include <span>
#include <variant>

namespace rimline {

class Mesh;

/// Every vertex moves along `direction`, by an amount that depends on its position along `travel`:
///
///     position = rest + amplitude * direction * sin(2 pi (travel · (rest - center) / length - turns))
///
/// With `travel` perpendicular to `direction` this is a shear: at any amplitude it neither folds space nor
/// turns anything inside out.
struct Wave {
    glm::dvec3 center{0.0};
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< Of length 1.
    glm::dvec3 travel{1.0, 0.0, 0.0};     ///< Of length 1.
    double amplitude = 0.1;
    double length = 1.0;  ///< Greater than 0.
    double turns = 0.0;   ///< How many lengths the wave has traveled.
};

/// Positions from the caller, one for each vertex of the mesh in its order (Mesh::positions()), all within
/// `radius` of `center`. They are copied while the frame is recorded, and must be valid until then.
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

/// A sphere around every vertex of the deformed mesh. O(1).
BoundingSphere bounding_sphere(const Mesh& mesh, const Deformation& deformation);

/// A default wave: along `up`, of any length but 0, with an amplitude of 0.1 radii of the mesh and a length of 1.5
/// radii.
Wave default_wave(const Mesh& mesh, const glm::dvec3& up, double turns);

}  // namespace rimline
