#pragma once

// Meshes with what makes lines difficult.

#include <cstdint>

#include "silhouette/mesh/mesh_source.h"

namespace rimline::tests {

/// A mesh with holes, faces the other way round, faces twice, and fins of up to a tenth of `size`.
MeshSource broken(const MeshSource& whole, std::uint64_t seed, float size = 1.0f);
/// The same of a knot.
MeshSource broken_knot(std::uint64_t seed);

/// Two knots that pass through each other, of about `faces` faces together.
MeshSource crossing_knots(std::uint32_t faces);

/// A sphere whose vertices are moved along their directions by at most `height`, at random: everywhere are short
/// lines.
MeshSource rough_sphere(std::uint32_t faces, float height, std::uint64_t seed);

}  // namespace rimline::tests
