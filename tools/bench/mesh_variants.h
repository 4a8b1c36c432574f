#pragma once

// A mesh changed a little, to see what stays the same: with fewer faces, with noise, in another pose.

#include <cstdint>
#include <glm/vec3.hpp>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline::tools {

/// With about so many faces, by edge collapses with least quadric error (meshoptimizer; Garland, Heckbert
/// 1997). More remain where the topology does not allow fewer.
MeshSource simplified(const Mesh& mesh, std::uint32_t faces);

/// Every vertex moved by this share of the mesh's radius, in random directions.
MeshSource with_noise(const Mesh& mesh, double share, std::uint32_t seed);

/// Bent around an axis parallel to `up` (Barr 1984), so that the ends of the longest extent perpendicular to
/// it point so many degrees apart: as an animal that turns. What has no such extent stays as it is.
MeshSource bent(const Mesh& mesh, const glm::dvec3& up, double degrees);

}  // namespace rimline::tools
