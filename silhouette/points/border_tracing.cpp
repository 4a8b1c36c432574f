#include "silhouette/points/border_tracing.h"

#include "silhouette/points/border_bend.h"
#include "silhouette/points/border_chains.h"
#include "silhouette/points/border_repair.h"

namespace rimline {

namespace {

// Bounds the time. Rounds end before where no point changes.
constexpr int k_max_repair_rounds = 6;

}  // namespace

std::vector<OpenPoint> trace_borders(std::span<const glm::dvec3> points,
                                     const NeighborLists& neighbors, const Stars& stars,
                                     double gap_ratio, const LongCall& call) {
    BorderGaps gaps({points, neighbors, stars, gap_ratio}, {call, 0.0, 0.5});
    for (int round = 0; round < k_max_repair_rounds && repair_gaps(gaps); ++round)
        call.checkpoint(0.5 + 0.3 * (round + 1) / k_max_repair_rounds);
    judge_chains(gaps, {call, 0.8, 1.0});
    std::vector<OpenPoint> open = gaps.take();
    straighten_borders(points, neighbors, open);
    return open;
}

}  // namespace rimline
