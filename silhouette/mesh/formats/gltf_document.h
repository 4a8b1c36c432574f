#pragma once

// Reads the document of a glTF file strictly: properties must have the right type, and extensions that change
// geometry are refused.

#include <string>
#include <string_view>

#include "silhouette/error.h"
#include "silhouette/mesh/formats/gltf_scene.h"

namespace rimline {

/// `json` is the document and `first_byte` its offset in the file. Throws Error{bad_input}. The message names
/// the byte of a JSON error. For a violation of glTF 2, or an extension that changes geometry, it names the
/// path: "accessors[3].count: ...". Faults of textures are warnings. Throws Error{cancelled}; reports progress
/// in [0, 1]. Cost: O(document) in time and memory: at most 20 times its size until it returns.
GltfScene read_gltf_scene(const std::string& name, std::string_view json, std::size_t first_byte,
                          const LongCall& call);

}  // namespace rimline
