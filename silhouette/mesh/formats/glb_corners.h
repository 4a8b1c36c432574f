#pragma once

// The vertices of a GLB file. In glTF a color belongs to a vertex, in a mesh to a corner of a face (face_materials.h).
// So a vertex whose corners have several colors becomes several vertices at one position. Welding joins them again.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The vertices are those of the mesh, with their numbers, and then the copies.
struct GlbCorners {
    std::vector<VertexId> copies;  ///< The mesh's vertex of each copy.
    /// The vertex of each corner, three for each face. Empty if there are no copies: then it is the mesh's.
    std::vector<std::uint32_t> vertices;
    /// Of each vertex, in linear light. Empty if the mesh has no colors of corners.
    std::vector<glm::vec3> colors;
};

/// Corners of faces without a material have no color: they use any vertex at their position.
/// O(corners), and O(n log n) for n corners whose vertex has another color at an earlier corner.
GlbCorners glb_corners(const Mesh& mesh);

}  // namespace rimline
