#pragma once

// Checks the JSON of a glTF file strictly, before tinygltf parses it.
//
// tinygltf truncates integers to 32 bits, treats a property of the wrong type as missing, recurses as deep as
// the file nests, opens every image, supports few data URIs, and rejects index accessors without a buffer
// view, which the format allows. So it gets a new document that holds only views, accessors, meshes, nodes
// and scenes, with properties of the right type. gltf_buffers.h reads the buffers. Indices are passed as an
// additional vertex attribute, k_gltf_indices.

#include <cstdint>
#include <filesystem>
#include <glm/mat3x2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/face_materials.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// The attribute that passes a primitive's index accessor to tinygltf.
constexpr const char* k_gltf_indices = "_RIMLINE_INDICES";

struct GltfBuffer {
    std::uint64_t size_bytes;
    std::string uri;  ///< Empty for the binary chunk of a GLB or a missing buffer.
};

/// The picture of a texture: bytes of a buffer, or what a URI names.
struct GltfImage {
    std::string place;  ///< "images[3]"
    std::string uri;    ///< Empty: bytes of a buffer.
    std::size_t buffer = 0;
    std::uint64_t offset_bytes = 0;
    std::uint64_t size_bytes = 0;
};

/// baseColorTexture of a material.
struct GltfTexture {
    GltfImage image;
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_pixelated = false;
    std::string coordinates;  ///< The attribute of a primitive that holds them: "TEXCOORD_0"
    /// Maps these coordinates to places of the picture (KHR_texture_transform).
    glm::mat3x2 transform{1.0f};
};

struct GltfMaterial {
    std::optional<glm::vec3> base_color;  ///< In linear light, if there is a baseColorFactor.
    std::optional<GltfTexture> texture;
};

struct GltfScene {
    std::string document;  ///< The document for tinygltf.
    std::vector<GltfBuffer> buffers;
    std::vector<GltfMaterial> materials;
    std::vector<std::string> warnings;  ///< About textures that cannot be used.
};

/// `json` is the document and `first_byte` its offset in the file. Throws Error{bad_input}. The message names
/// the byte of a JSON error. For a violation of glTF 2, or an extension that changes geometry, it names the
/// path: "accessors[3].count: ...". Faults of textures are warnings.
GltfScene read_gltf_scene(const std::string& name, std::string_view json, std::size_t first_byte);

}  // namespace rimline
