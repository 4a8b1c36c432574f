#pragma once

// The vertices of a GLB file. In glTF a color and texture coordinates belong to a vertex, in a mesh to a corner of a
// face (face_materials.h). So a vertex whose corners have several of them becomes several vertices at one position.
// Welding joins them again.

#include <cstdint>
#include <glm/vec2.hpp>
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
    /// Of each vertex. Empty if no face has a texture that can be written.
    std::vector<glm::vec2> uvs;
};

/// Whether the faces of this material have a texture that can be written: its bytes are there (embed_textures()), and
/// are PNG or JPEG.
bool has_embedded_texture(const FaceMaterials& materials, MaterialId material) noexcept;

/// Corners of faces without a material have no color, and those without such a texture no coordinates: they use any
/// vertex at their position that has the rest. O(corners), and O(n log n) for n corners whose vertex has another color
/// or other coordinates at an earlier corner.
GlbCorners glb_corners(const Mesh& mesh);

}  // namespace rimline
