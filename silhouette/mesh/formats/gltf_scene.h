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
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// The attribute that passes a primitive's index accessor to tinygltf.
constexpr const char* k_gltf_indices = "_RIMLINE_INDICES";

struct GltfBuffer {
    std::uint64_t size_bytes;
    std::string uri;  ///< Empty for the binary chunk of a GLB or a missing buffer.
};

struct GltfScene {
    std::string document;  ///< The document for tinygltf.
    std::vector<GltfBuffer> buffers;
    /// baseColorFactor of each material, in linear light, if it names one.
    std::vector<std::optional<glm::vec3>> base_colors;
};

/// `json` is the document and `first_byte` its offset in the file. Throws Error{bad_input}. The message names
/// the byte of a JSON error. For a violation of glTF 2, or an extension that changes geometry, it names the
/// path: "accessors[3].count: ...".
GltfScene read_gltf_scene(const std::string& name, std::string_view json, std::size_t first_byte);

}  // namespace rimline
