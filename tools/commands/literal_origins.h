#pragma once

// `rimline origins --literal`: the work of the thesis's own octrees over the same groups of faces.

#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// One way to skip nodes and to list edges (literal_forest.h). Counts are means of one extraction; those of
/// checks are rounded down.
struct LiteralTrial {
    const char* culling;
    const char* listing;
    std::uint32_t tree_edges = 0;
    std::uint32_t listed_edges = 0;
    std::uint64_t pbv_checks = 0;
    std::uint64_t ebv_checks = 0;
    std::uint64_t edge_checks = 0;
    std::uint64_t face_checks = 0;
    double missed_edges = 0.0;    ///< Of the silhouette by brute force.
    double repeated_edges = 0.0;  ///< Found a second time.
    bool is_complete = true;      ///< LiteralForestOptions::is_complete().
    std::uint32_t differing = 0;  ///< Extractions that differ from brute force.

    std::uint64_t box_checks() const noexcept { return pbv_checks + ebv_checks; }
};

/// Counts `viewpoints` extractions by both cullings, by the thesis's with either list: complete first, then
/// to the letter of 4.4.5, then straddling. Without `origins`, the mesh's center is the only one. Throws
/// Error in a build without the other methods.
std::vector<LiteralTrial> count_literal_work(const Mesh& mesh, std::span<const glm::dvec3> origins,
                                             std::uint32_t viewpoints, const LongCall& call);

/// Names the first trial that is complete and yet differs from brute force. Empty if there is none.
std::string difference_of(std::span<const LiteralTrial> trials);

nlohmann::ordered_json to_json(std::span<const LiteralTrial> trials);

}  // namespace rimline::tools
