#pragma once

// What the geometry and the colors of a glTF file need of its document (gltf_document.h).
//
// Numbers of other objects are as in the file: whoever follows them checks them. Lists lie one after the other in
// common vectors (nodes in `children`, meshes in `primitives`), and a node takes 24 bytes, so the scene is at most a
// few times larger than its text.

#include <cstdint>
#include <deque>
#include <glm/mat3x2.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/face_materials.h"

namespace rimline {

struct GltfBuffer {
    std::uint64_t size_bytes;
    std::string_view uri;  ///< Empty for the binary chunk of a GLB or a missing buffer.
};

struct GltfView {
    std::uint32_t buffer;
    std::uint32_t offset_bytes;
    std::uint32_t size_bytes;
    std::uint32_t stride_bytes;  ///< 0: its elements have no gaps.
};

enum class GltfType : std::uint8_t { scalar, vec2, vec3, vec4, matrix };

/// Elements that replace those of an accessor.
struct GltfSparse {
    std::uint32_t count;
    std::uint32_t indices_view;
    std::uint32_t indices_offset_bytes;
    std::uint32_t indices_component;  ///< As in GltfAccessor.
    std::uint32_t values_view;
    std::uint32_t values_offset_bytes;
};

struct GltfAccessor {
    std::optional<std::uint32_t> view;  ///< None: its elements are zeros.
    std::uint32_t offset_bytes;
    std::uint32_t count;
    std::uint32_t component;  ///< glTF's number of the type of one number: 5126 for float.
    GltfType type;
    bool is_normalized;
    std::optional<GltfSparse> sparse;
};

/// The picture of a texture: bytes of a buffer, or what a URI names.
struct GltfImage {
    std::uint32_t number;  ///< In the document's "images".
    std::string_view uri;  ///< Empty: bytes of a buffer.
    GltfView view{};       ///< Of these bytes.
};

/// baseColorTexture or diffuseTexture of a material.
struct GltfTexture {
    std::uint32_t image;  ///< In GltfScene::images.
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_pixelated = false;
    /// Of its coordinates: 1 for the attribute TEXCOORD_1 of a primitive.
    std::uint32_t coordinate_set = 0;
    /// Maps these coordinates to places of the picture (KHR_texture_transform).
    glm::mat3x2 transform{1.0f};
};

struct GltfMaterial {
    /// In linear light, if there is a baseColorFactor or diffuseFactor.
    std::optional<glm::vec3> base_color;
    std::optional<std::uint32_t> texture;  ///< In GltfScene::textures.
};

/// The extension of primitives that says when their edges are drawn.
constexpr const char* k_gltf_edges = "EXT_mesh_primitive_edge_visibility";

// Modes of primitives. Lower ones are points and lines.
constexpr std::uint32_t k_gltf_triangles = 4;
constexpr std::uint32_t k_gltf_triangle_strip = 5;
constexpr std::uint32_t k_gltf_triangle_fan = 6;

/// The members are numbers of accessors and of a material.
struct GltfPrimitive {
    std::uint32_t mode;
    std::optional<std::uint32_t> positions;
    std::optional<std::uint32_t> indices;
    std::optional<std::uint32_t> colors;
    std::optional<std::uint32_t> uvs;  ///< Of its material's texture. None if that is not in order.
    std::optional<std::uint32_t> material;
    std::optional<std::uint32_t> edges;  ///< In GltfScene::edges.
};

/// Elements of a vector, `end` excluded.
struct GltfRange {
    std::uint32_t begin;
    std::uint32_t end;
};

/// EXT_mesh_primitive_edge_visibility of a primitive: numbers of accessors.
struct GltfEdges {
    std::optional<std::uint32_t> visibility;
    std::optional<std::uint32_t> silhouette_normals;
    GltfRange line_strings;  ///< Of GltfScene::line_strings.
};

struct GltfTransform {
    glm::dmat4x3 parent_from_node;
    const char*
        fault;  ///< Why it cannot be used, or null. An error only if its node is part of the scene.
};

struct GltfNode {
    std::optional<std::uint32_t> mesh;
    std::optional<std::uint32_t> transform;  ///< In GltfScene::transforms.
    GltfRange children;                      ///< Of GltfScene::children.
};

struct GltfScene {
    std::vector<GltfBuffer> buffers;
    std::vector<GltfView> views;
    std::vector<GltfAccessor> accessors;
    std::vector<GltfImage> images;
    std::vector<GltfTexture> textures;
    std::vector<GltfMaterial> materials;
    std::vector<GltfPrimitive> primitives;
    std::vector<GltfRange> meshes;  ///< Of `primitives`.
    std::vector<GltfEdges> edges;
    std::vector<std::uint32_t> line_strings;  ///< Accessors of indices.
    std::deque<GltfTransform> transforms;
    std::vector<std::uint32_t> children;  ///< Numbers of nodes.
    std::vector<GltfNode> nodes;
    /// The nodes of the default scene, else of the first scene, else all nodes without a parent.
    std::vector<std::uint32_t> roots;
    /// Whether the file lists KHR_mesh_quantization: positions and texture coordinates may be integers of 8 or 16 bits.
    bool is_quantized = false;
    std::vector<std::string> warnings;  ///< About textures that cannot be used.
    std::deque<std::string> strings;    ///< The URIs are views of these.
};

}  // namespace rimline
