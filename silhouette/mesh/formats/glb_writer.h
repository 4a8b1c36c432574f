#pragma once

// Writes a mesh as GLB, the binary form of glTF 2, with the classes of its edges as the extension
// EXT_mesh_primitive_edge_visibility (edge_visibility.h, gltf_edges.h). CesiumJS, Cesium for Unreal and iTwin.js
// draw such edges.
//
// A primitive for each material, each with the faces of it in their order; faces without a material are one, too.
// All share the welded vertices, and copies of those whose corners have several colors (glb_corners.h). Each edge has
// its class at one of its faces, the first as they are written, also if its other faces are in other primitives.
//
// Viewers decide on which silhouettes an edge is by two normals. As signed bytes they are wrong by up to half a
// degree (docs/results/edges.md has what that does); as floats they are as our own.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "silhouette/mesh/edge_visibility.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

enum class SilhouetteNormals : std::uint8_t {
    bytes,  ///< Signed bytes, the only ones that CesiumJS reads: 8 bytes an edge.
    floats  ///< 24 bytes an edge.
};

struct GlbOptions {
    /// The class of each edge of the mesh. Empty: the file says nothing about edges.
    std::span<const EdgeVisibility> edges = {};
    SilhouetteNormals normals = SilhouetteNormals::bytes;
    /// The mesh's up direction, along an axis: where it is not y, a node turns it to glTF's, which is y.
    glm::dvec3 up{0.0, 1.0, 0.0};
};

/// The bytes of the file. Base colors of materials and colors of corners are kept exactly, as linear floats (COLOR_0).
/// Textures are kept, with the bytes of their files, if these are there (embed_textures()); others are left out. `mesh`
/// must have faces. Throws Error{too_large} if the file would have 2^31 bytes or more. O(vertices + faces + edges +
/// bytes of textures), and glb_corners(); in memory the file, one byte for each edge, and up to 60 bytes for each
/// corner of a mesh with colors of corners or textures.
std::string glb_bytes(const Mesh& mesh, const GlbOptions& options);

/// The outward unit normals of the two faces of an edge, that of `first`, one of its faces, before the other's,
/// which is turned round if both faces traverse the edge in the same direction. A face that is missing or has no
/// plane gets the opposite of the other's normal, so that viewers draw the edge.
std::array<glm::vec3, 2> silhouette_normals(const Mesh& mesh, EdgeId edge, FaceId first) noexcept;

/// A unit vector as three signed bytes, to be divided by 127: the nearest.
std::array<std::int8_t, 3> normal_bytes(glm::vec3 normal) noexcept;

}  // namespace rimline
