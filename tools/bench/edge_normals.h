#pragma once

// How viewers judge silhouette edges by the normals that a file gives them (EXT_mesh_primitive_edge_visibility),
// beside the bits of the faces. A viewer draws an edge if one of its normals points towards the eye and the other
// does not, seen from the middle of the edge.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/edge_visibility.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

enum class StoredNormals : std::uint8_t {
    bytes,         ///< Three signed bytes, as the library writes them.
    cesium_bytes,  ///< The same as CesiumJS decodes them: (2b + 1) / 255.
    oct16,         ///< The octahedron in two bytes, as the first draft of the extension had them.
    floats
};
constexpr std::size_t k_stored_normals = 4;
constexpr std::array<const char*, k_stored_normals> k_stored_normal_names{"bytes", "CesiumJS",
                                                                          "oct16", "floats"};

/// What a reader gets of a unit vector. It may have another length.
glm::vec3 stored_and_read(glm::vec3 normal, StoredNormals stored) noexcept;

struct MisjudgedEdges {
    std::uint64_t missed = 0;  ///< On the silhouette, and not drawn.
    std::uint64_t extra = 0;   ///< Drawn, and not on the silhouette.
};

/// Sums over all views.
struct EdgeNormalsResult {
    std::uint64_t silhouette = 0;  ///< Edges on silhouettes, of the class silhouette.
    std::uint64_t hidden = 0;      ///< Edges on silhouettes, of the class hidden.
    std::array<MisjudgedEdges, k_stored_normals> misjudged{};
};

/// From `views` points around the mesh, at one, two and three radii. `edges` has the class of each edge. O(views *
/// (faces + edges)), in parallel.
EdgeNormalsResult judge_edges(const Mesh& mesh, const std::vector<EdgeVisibility>& edges,
                              std::uint32_t views, const LongCall& call);

}  // namespace rimline::tools
