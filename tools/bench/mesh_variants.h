#pragma once

// Variants of a mesh: with noise, in another pose. They test whether a result is stable.

#include <cstdint>
#include <glm/vec3.hpp>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline::tools {

/// Moves every vertex by this share of the mesh's radius, in random directions.
MeshSource with_noise(const Mesh& mesh, double share, std::uint32_t seed);

/// Bends the mesh around an axis parallel to `up` (Barr 1984), so that the ends of its longest extent
/// perpendicular to `up` point `degrees` apart, like an animal that turns. A mesh without such an extent
/// stays unchanged.
MeshSource bent(const Mesh& mesh, const glm::dvec3& up, double degrees);

}  // namespace rimline::tools
