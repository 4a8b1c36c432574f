#pragma once

// The node tree of a glTF scene: which meshes appear, and where.

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <stop_token>
#include <string>

#include "silhouette/mesh/formats/gltf_scene.h"

namespace rimline {

/// Calls visit(mesh, scene_from_mesh) for each node of the scene that names a mesh, parents before children, and
/// for each mesh if there are no nodes. `mesh` is an index in scene.meshes. Throws Error{bad_input} if a node or a
/// mesh is missing, a node is reached twice, or a transform cannot be used; Error{cancelled} if `stop` is requested.
/// Cost: O(nodes) and the calls. Does not recurse: a chain of nodes may be as long as the file.
void for_each_instance(const std::string& file, const GltfScene& scene, const std::stop_token& stop,
                       const std::function<void(std::uint32_t, const glm::dmat4&)>& visit);

}  // namespace rimline
