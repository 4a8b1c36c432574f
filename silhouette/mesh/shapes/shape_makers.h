#pragma once

// The functions behind make_built_in_shape, one source file each. `faces` is an approximate number,
// as there, but 0 does not select a default. No two vertices of one shape are equal.

#include <cstdint>

#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// The unit sphere: each face of an icosahedron is split into n * n triangles. 20 n^2 faces.
MeshSource make_sphere(std::uint32_t faces);

/// Around the y axis. `major_radius` is from the axis to the tube's center, `minor_radius` is the
/// tube's radius.
MeshSource make_torus(std::uint32_t faces, double major_radius, double minor_radius);

/// A tube around the (2,3) torus knot, which winds twice around the z axis. At least 144 faces.
MeshSource make_knot(std::uint32_t faces);

/// [-1, 1]^3, each side split into n * n squares. 12 n^2 faces.
MeshSource make_box(std::uint32_t faces);

/// Four turns of a tube around the y axis, with rounded ends. At least 174 faces.
MeshSource make_spring(std::uint32_t faces);

/// A height field over [-1, 1]^2 in x and z. 2 n^2 faces.
MeshSource make_terrain(std::uint32_t faces);

/// The scene that is drawn if no model is given.
MeshSource make_scene(std::uint32_t faces);

}  // namespace rimline
