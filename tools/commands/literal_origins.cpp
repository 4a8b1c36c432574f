#include "tools/commands/literal_origins.h"

#include <algorithm>
#include <iterator>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/methods/literal/literal_forest.h"

namespace rimline::tools {

namespace {

struct LiteralWay {
    const char *culling_name, *listing_name;
    LiteralCulling culling;
    LiteralListing listing;
};

constexpr LiteralWay k_literal_ways[] = {
    {"points_and_edges", "sfo_from_any", LiteralCulling::points_and_edges,
     LiteralListing::sfo_from_any},
    {"points_and_edges", "sfo_from_all", LiteralCulling::points_and_edges,
     LiteralListing::sfo_from_all},
    {"straddling", "sfo_from_all", LiteralCulling::straddling, LiteralListing::sfo_from_all},
};

}  // namespace

std::vector<LiteralTrial> count_literal_work(const Mesh& mesh, std::span<const glm::dvec3> origins,
                                             std::uint32_t viewpoints, const LongCall& call) {
    std::vector<glm::dvec3> used(origins.begin(), origins.end());
    if (used.empty()) used.push_back(mesh.center());
    const std::vector<std::uint32_t> groups = HoughOctree(mesh, {used}).face_groups();
    const std::vector<HomogeneousPoint> points = spread_viewpoints(mesh, viewpoints);
    std::vector<std::vector<EdgeId>> truths;
    for (const HomogeneousPoint& point : points) {
        call.checkpoint(0.0);
        truths.push_back(brute_force_silhouette(mesh, point));
    }
    std::vector<LiteralTrial> trials;
    for (const LiteralWay& way : k_literal_ways) {
        const double begin = double(trials.size()) / double(std::size(k_literal_ways));
        const LiteralForestOptions options{way.culling, way.listing, {}};
        const LiteralForest forest(mesh, used, groups, options);
        LiteralCounters sum;
        std::uint64_t missed = 0;
        std::uint64_t repeated = 0;
        std::uint32_t differing = 0;
        std::vector<EdgeId> edges;
        for (std::size_t i = 0; i < points.size(); ++i) {
            call.checkpoint(begin + double(i) / double(3 * points.size()));
            forest.extract(points[i], edges, sum);
            std::ranges::sort(edges);
            differing += edges != truths[i];
            const auto last = std::unique(edges.begin(), edges.end());
            repeated += static_cast<std::uint64_t>(edges.end() - last);
            edges.erase(last, edges.end());
            std::vector<EdgeId> lost;
            std::ranges::set_difference(truths[i], edges, std::back_inserter(lost));
            missed += lost.size();
        }
        LiteralTrial& trial = trials.emplace_back(
            LiteralTrial{.culling = way.culling_name, .listing = way.listing_name});
        trial.tree_edges = forest.statistics().tree_edges;
        trial.listed_edges = forest.statistics().listed_edges;
        trial.pbv_checks = sum.pbv_checks / viewpoints;
        trial.ebv_checks = sum.ebv_checks / viewpoints;
        trial.edge_checks = sum.edge_tests / viewpoints;
        trial.face_checks = sum.face_checks / viewpoints;
        trial.missed_edges = static_cast<double>(missed) / viewpoints;
        trial.repeated_edges = static_cast<double>(repeated) / viewpoints;
        trial.is_complete = options.is_complete();
        trial.differing = differing;
    }
    return trials;
}

}  // namespace rimline::tools
