#pragma once

// Sheets that a file has twice, back to back, so that programs which cull back faces show both sides: doors,
// leaves, clothes. Rimline draws both sides of every face. There the second sheet only harms: each of its edges
// meets four faces and would be a line, and what is drawn twice in one place mixes its colors.

#include <cstdint>
#include <string>

#include "silhouette/mesh/mesh_source.h"

namespace rimline::tools {

/// Removes each face that has the corners of an earlier one, at equal positions and in either order. The
/// earlier one keeps its material for both sides. Degenerate faces stay. Polygons of both sheets are cut alike
/// (triangulate.h); sheets whose file has triangles, cut along other diagonals, are not found. Returns how many are
/// removed. O(faces) expected.
std::uint32_t remove_double_faces(MeshSource& source);

/// The same for the model of this name, with a warning in the source that says how many there were.
void draw_double_faces_once(const std::string& model, MeshSource& source);

}  // namespace rimline::tools
