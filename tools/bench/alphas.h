#pragma once

// `rimline bench fields --alphas`: Figure 4.9 for several models and numbers of origins, what an extraction
// costs over the α of origin_function (Figure 4.8).
//
// The thesis's α can be read in two ways: where votes end, or, as "the ideal distance" of 4.4.6, where they
// peak. Ours is the first and votes peak at α/2. So a thesis's α of the second reading is one of twice the
// size here, and the alphas go up to 6.
//
// Counts are of the thesis's octrees, PBVs and EBVs apart (literal_origins.h), and of HoughOctree. The
// baseline is the center as the one origin. Each complete extraction is compared with brute force.

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "silhouette/field/origins.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"
#include "tools/commands/literal_origins.h"

namespace rimline::tools {

constexpr std::array<double, 13> k_alphas{0.4,  0.6, 0.8, 1.0, 1.2,  1.4, 1.6,
                                          1.72, 2.0, 2.4, 3.0, 3.44, 6.0};

struct AlphaOptions {
    std::uint32_t max_origins = 4;
    std::uint32_t viewpoints = 600;
};

/// The work of an extraction with the first `trial.count` origins of one α.
struct AlphaRow {
    double alpha = 0.0;  ///< 0 for the center.
    OriginTrial trial;
    std::vector<LiteralTrial> literal;  ///< As of count_literal_work().
};

struct AlphaResult {
    std::string model;
    std::uint32_t faces = 0;
    AlphaRow center;
    std::vector<AlphaRow> rows;  ///< By number of origins, then by α. None where votes end before.
    std::string difference{};    ///< The first from brute force; empty if none.
};

/// Takes minutes for a quarter of a million faces. Throws Error in a build without the other methods.
AlphaResult bench_alphas(const std::string& model, const Mesh& mesh, const AlphaOptions& options,
                         const Context& context);

/// Over models, for one α and number of origins: geometric means of the counts over those of the center.
struct AlphaMean {
    double alpha = 0.0;
    std::uint32_t origins = 0;
    std::uint32_t models = 0;
    double literal_boxes = 1.0;  ///< The thesis's culling, the complete list.
    double letter_boxes = 1.0;   ///< The thesis's culling, its own list.
    double work = 1.0;           ///< OriginTrial::work, of HoughOctree.
    double index_boxes = 1.0;
};
/// Models whose center costs no boxes do not count: all their faces lie in one plane.
std::vector<AlphaMean> means_of(const std::vector<AlphaResult>& results);

void print_result(const AlphaResult& result);
void print_means(const std::vector<AlphaMean>& means);
nlohmann::ordered_json to_json(const AlphaResult& result);
nlohmann::ordered_json to_json(const std::vector<AlphaMean>& means);

}  // namespace rimline::tools
