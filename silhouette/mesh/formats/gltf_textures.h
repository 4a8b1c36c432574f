#pragma once

// The textures of a glTF's materials.

#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/gltf_buffers.h"
#include "silhouette/mesh/formats/gltf_scene.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// The texture of `texture`, with a copy of its bytes if they are in the document. `texture` must be of the
/// document `file`, whose buffers are `buffers`. Throws Error{bad_input}, where the bytes or the file cannot be
/// named. Textures of one image share its bytes through `known`.
MaterialTexture material_texture(const SourceFile& file, const GltfTexture& texture,
                                 const GltfBuffers& buffers,
                                 std::map<std::string, std::shared_ptr<const std::string>>& known);

}  // namespace rimline
