#include "tools/commands/literal_origins.h"

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/methods/literal/literal_forest.h"
#include "tools/progress.h"

namespace rimline::tools {

std::vector<LiteralTrial> count_literal_work(const Mesh& mesh, std::span<const glm::dvec3> origins,
                                             std::uint32_t viewpoints, const Context& context) {
    std::vector<glm::dvec3> used(origins.begin(), origins.end());
    if (used.empty()) used.push_back(mesh.center());
    const std::vector<std::uint32_t> groups = HoughOctree(mesh, {used}).face_groups();
    const std::vector<HomogeneousPoint> points = spread_viewpoints(mesh, viewpoints);
    Progress progress(context, "counting the thesis's boxes");
    const LongCall call = progress.call();
    std::vector<LiteralTrial> trials = {{"points_and_edges"}, {"straddling"}};
    for (LiteralTrial& trial : trials) {
        const bool is_second = &trial == &trials.back();
        const LiteralForest forest(
            mesh, used, groups,
            is_second ? LiteralCulling::straddling : LiteralCulling::points_and_edges);
        LiteralCounters sum;
        std::vector<EdgeId> edges;
        for (std::size_t i = 0; i < points.size(); ++i) {
            call.checkpoint(0.5 * is_second + 0.5 * double(i) / double(points.size()));
            forest.extract(points[i], edges, sum);
        }
        trial.tree_edges = forest.statistics().tree_edges;
        trial.listed_edges = forest.statistics().listed_edges;
        trial.box_checks = sum.box_checks() / viewpoints;
        trial.edge_checks = sum.edge_tests / viewpoints;
        trial.face_checks = sum.face_checks / viewpoints;
    }
    return trials;
}

}  // namespace rimline::tools
