#include "silhouette/field/origins.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "silhouette/field/named_functions.h"
#include "silhouette/field/points_of_interest.h"
#include "silhouette/hough/spread_viewpoints.h"

namespace rimline {

namespace {

constexpr SearchDomain k_ball{0.0, 3.0};
constexpr double k_edge_work = 2.0;

}  // namespace

OriginSet find_origins(const Mesh& mesh, std::uint32_t count, const OriginOptions& options,
                       const LongCall& call) {
    RIMLINE_CHECK(options.alpha > 0.0);
    call.checkpoint(0.0);
    const glm::dvec3 c = glm::abs(mesh.center());
    if (std::max({c.x, c.y, c.z}) + k_ball.outer_radius * mesh.radius() > k_max_coordinate)
        throw Error(ErrorCode::too_large,
                    "coordinates are too large for origins around the model: scale it down");
    const UnitPlanes planes(mesh, call.stop);
    const TangentialField field(planes, origin_function(options.alpha), {options.field_tolerance},
                                call.stop);
    InterestOptions interest;
    interest.count = count;
    interest.tolerance = options.tolerance;
    const PointsOfInterest found =
        find_points_of_interest(field, k_ball, interest, call.part(0.1, 1.0));
    OriginSet result;
    for (const PointOfInterest& point : found.points) {
        result.origins.push_back(planes.frame().to_model(point.point));
        result.votes.push_back(point.votes / field.total_weight());
    }
    if (result.origins.empty()) {
        result.origins.push_back(mesh.center());
        result.votes.push_back(0.0);
    }
    return result;
}

OriginTrial try_origins(const Mesh& mesh, std::vector<glm::dvec3> origins, std::uint32_t viewpoints,
                        const LongCall& call) {
    RIMLINE_CHECK(viewpoints >= 1);
    OriginTrial trial;
    trial.count = static_cast<std::uint32_t>(origins.size());
    const HoughOctree octree(mesh, {std::move(origins)}, call.part(0.0, 0.5));
    trial.statistics = octree.statistics();
    const std::vector<HomogeneousPoint> points = spread_viewpoints(mesh, viewpoints);
    const LongCall silent{call.stop, {}};
    const TraversalCounters sum = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, points.size(), 16), TraversalCounters{},
        [&](const tbb::blocked_range<std::size_t>& part, TraversalCounters counters) {
            silent.checkpoint(0.0);
            BlockScratch scratch = octree.make_scratch();
            std::vector<EdgeId> edges;
            for (std::size_t i = part.begin(); i < part.end(); ++i)
                octree.extract(points[i], edges, counters, scratch);
            return counters;
        },
        [](TraversalCounters a, const TraversalCounters& b) { return a += b; });
    trial.mean = {sum.box_checks / viewpoints, sum.face_checks / viewpoints,
                  sum.edge_checks / viewpoints};
    trial.work =
        (static_cast<double>(sum.box_checks) + k_edge_work * static_cast<double>(sum.edge_checks)) /
        viewpoints;
    call.checkpoint(1.0);
    return trial;
}

ChosenOrigins choose_origins(const Mesh& mesh, std::uint32_t max_count, std::uint32_t viewpoints,
                             const OriginOptions& options, const LongCall& call) {
    RIMLINE_CHECK(max_count >= 1);
    ChosenOrigins chosen;
    chosen.found = find_origins(mesh, max_count, options, call.part(0.0, 0.5));
    const auto& origins = chosen.found.origins;
    for (std::size_t k = 0; k <= origins.size(); ++k) {
        const double share = 0.5 / static_cast<double>(origins.size() + 1);
        const double begin = 0.5 + share * static_cast<double>(k);
        chosen.trials.push_back(
            try_origins(mesh, {origins.begin(), origins.begin() + static_cast<std::ptrdiff_t>(k)},
                        viewpoints, call.part(begin, begin + share)));
        if (chosen.trials.back().work < chosen.trials[chosen.best].work)
            chosen.best = static_cast<std::uint32_t>(k);
    }
    return chosen;
}

}  // namespace rimline
