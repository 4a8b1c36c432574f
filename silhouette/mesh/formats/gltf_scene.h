#pragma once

// A strict reading of a glTF file's JSON, before tinygltf parses it.
//
// tinygltf cuts integers to 32 bits, takes a property of the wrong type for a missing one, recurses as
// deep as the file nests, opens every image, knows few data URIs, and refuses index accessors without a buffer view, which
// the format allows. So it is given a document of our own making: views, accessors, meshes, nodes and
// scenes, each property of the right type, and nothing else. Buffers are read by gltf_buffers.h. Indices travel as one more
// vertex attribute, k_gltf_indices.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// The attribute that a primitive's indices accessor is handed on as.
constexpr const char* k_gltf_indices = "_RIMLINE_INDICES";

struct GltfBuffer {
    std::uint64_t size_bytes;
    std::string uri;  ///< Empty: the binary chunk of a GLB, or nothing.
};

struct GltfScene {
    std::string document;  ///< What tinygltf may read.
    std::vector<GltfBuffer> buffers;
};

/// `json` is the document, `first_byte` where it lies in the file. Throws Error{bad_input} with the
/// byte of what is no JSON, or the path of what is no glTF 2 or needs an extension that changes
/// geometry: "accessors[3].count: ...".
GltfScene read_gltf_scene(const std::string& name, std::string_view json, std::size_t first_byte);

}  // namespace rimline
