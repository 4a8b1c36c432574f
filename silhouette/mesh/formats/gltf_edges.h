#pragma once

// When the edges of a primitive of glTF are drawn: the extension EXT_mesh_primitive_edge_visibility.
//
// `visibility` has two bits for each edge of each triangle, in their order (MeshSource::edge_codes). `lineStrings`
// are strips of edges that are always drawn and have no bits. For each silhouette edge, `silhouetteNormals` has the
// two normals of its faces; the mesh has better ones, so only their number is checked.
//
// After the README of the extension in KhronosGroup/glTF at commit fff86b4, but for its silhouetteMates, which
// later became silhouetteNormals of floats or signed bytes (docs/results/edges.md).

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/gltf_accessor.h"
#include "silhouette/mesh/formats/gltf_scene.h"

namespace rimline {

/// The codes of `triangles`, those of the primitive whose extension is scene.edges[edges], with `vertices`
/// vertices. Calls fail(what), which must throw, where the extension is violated. Accessors throw Error{bad_input}.
/// O(n log n) in the number of triangles, however long the lists of the file are.
std::vector<std::uint8_t> read_gltf_edges(const GltfScene& scene, const GltfAccessors& accessors,
                                          std::uint32_t edges,
                                          std::span<const std::array<std::uint32_t, 3>> triangles,
                                          std::uint32_t vertices,
                                          const std::function<void(const std::string&)>& fail);

/// The codes of the triangle with corners 0, 2, 1.
constexpr std::uint8_t mirrored_edge_codes(std::uint8_t codes) noexcept {
    return static_cast<std::uint8_t>((codes & 0x0c) | (codes & 0x03) << 4 | codes >> 4);
}

}  // namespace rimline
