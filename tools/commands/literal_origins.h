#pragma once

// `rimline origins --literal`: the work of the thesis's own octrees over the same groups of faces.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

/// One of the thesis's two cullings. Counts are means of one extraction, rounded down.
struct LiteralTrial {
    const char* culling;
    std::uint32_t tree_edges = 0;
    std::uint32_t listed_edges = 0;
    std::uint64_t box_checks = 0;
    std::uint64_t edge_checks = 0;
    std::uint64_t face_checks = 0;
};

/// Counts `viewpoints` extractions by each culling. Without `origins`, the mesh's center is the only one.
/// Throws Error in a build without the other methods.
std::vector<LiteralTrial> count_literal_work(const Mesh& mesh, std::span<const glm::dvec3> origins,
                                             std::uint32_t viewpoints, const Context& context);

}  // namespace rimline::tools
