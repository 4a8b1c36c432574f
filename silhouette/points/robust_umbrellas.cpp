#include "silhouette/points/robust_umbrellas.h"

#include <utility>

#include "silhouette/points/border_tracing.h"
#include "silhouette/points/crease_points.h"
#include "silhouette/points/each_point.h"
#include "silhouette/points/star_choice.h"

namespace rimline {

UmbrellaSet find_robust_umbrellas(std::span<const glm::dvec3> points,
                                  const NeighborLists& neighbors,
                                  const PointSurfaceOptions& options, const LongCall& call) {
    Stars stars = choose_stars(points, neighbors, options.gap_ratio, call.part(0.0, 0.7));
    const std::vector<OpenPoint> open_points =
        trace_borders(points, neighbors, stars, options.gap_ratio, call.part(0.7, 0.95));

    UmbrellaSet found{
        std::move(stars.fans),    std::move(stars.normals),
        std::move(stars.scales),  std::vector<PointLabel>(points.size(), PointLabel::interior),
        std::move(stars.reasons), {}};
    Neighborhood around;
    for (const OpenPoint& open : open_points) {
        const std::uint32_t point = open.point;
        around.assign(points, point, neighbors.of(point));
        // A gap that is no border is closed again where the point's star is whole.
        const bool is_whole = open.fan.gaps == 0;
        const bool is_spurious = open.verdict == OpenPoint::Verdict::none && !is_whole;
        if (is_spurious && found.fans[point].gaps == 0) {
            const glm::dvec3 normal = around.normal(found.fans[point]);
            if (normal != glm::dvec3(0.0)) found.normals[point] = normal;
            continue;
        }
        found.fans[point] = open.fan;
        found.normals[point] = around.normal(open.fan);
        if (found.normals[point] == glm::dvec3(0.0)) {
            found.reasons[point] = UndecidedReason::no_normal;
            continue;
        }
        if (is_whole) {
            found.labels[point] = PointLabel::interior;
        } else if (open.verdict == OpenPoint::Verdict::border) {
            found.labels[point] = PointLabel::border;
        } else if (is_spurious) {
            found.reasons[point] = UndecidedReason::unconfirmed_border;
        } else {
            found.labels[point] = PointLabel::feature;
            found.supplements.push_back({point, open.supplement, around.normal(open.supplement)});
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        // All sectors of a star may be gaps: its neighbors changed after it was judged by them.
        if (found.labels[i] == PointLabel::interior && found.reasons[i] == UndecidedReason::none &&
            (found.fans[i].gaps != 0 || found.normals[i] == glm::dvec3(0.0)))
            found.reasons[i] = UndecidedReason::no_normal;
        if (found.reasons[i] == UndecidedReason::none) continue;
        found.labels[i] = PointLabel::undecided;
        if (found.reasons[i] != UndecidedReason::unconfirmed_border) found.fans[i].size = 0;
    }
    split_at_creases(points, neighbors, found, call.part(0.95, 1.0));
    return found;
}

}  // namespace rimline
