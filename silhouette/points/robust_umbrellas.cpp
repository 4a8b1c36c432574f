#include "silhouette/points/robust_umbrellas.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/points/each_point.h"
#include "silhouette/points/neighbourhood.h"

namespace rimline {

namespace {

// Of a neighbour's edge with the plane: 50 degrees.
constexpr double k_sine_of_candidates = 0.766;

}  // namespace

FoundUmbrellas find_robust_umbrellas(std::span<const glm::dvec3> points,
                                     const NeighbourLists& neighbours,
                                     const PointSurfaceOptions& options, const LongCall& call) {
    const auto count = static_cast<std::uint32_t>(points.size());
    std::vector<Fan> fans(count);
    FoundUmbrellas found;
    found.scales.assign(count, 0.0);
    found.labels.assign(count, PointLabel::undecided);
    found.reasons.assign(count, UndecidedReason::none);
    each_point(count, {call, 0.0, 0.5}, [&](std::uint32_t first, std::uint32_t last) {
        Neighbourhood around;
        for (std::uint32_t i = first; i < last; ++i) {
            around.look_from(points, i, neighbours.of(i));
            if (!neighbours.is_mutual(i)) {
                found.reasons[i] =
                    around.size() == 0 ? UndecidedReason::alone : UndecidedReason::isolated;
            } else if (around.is_collinear()) {
                found.reasons[i] = UndecidedReason::collinear;
            } else {
                const glm::dvec3 normal = around.fitted_normal(neighbours.nearest_count());
                fans[i] = around.star(normal, k_sine_of_candidates);
                found.scales[i] = around.scale(fans[i]);
                if (!fans[i].is_umbrella()) found.reasons[i] = UndecidedReason::no_normal;
            }
        }
    });
    std::vector<glm::dvec3> normals(count);
    each_point(count, {call, 0.5, 1.0}, [&](std::uint32_t first, std::uint32_t last) {
        Neighbourhood around;
        for (std::uint32_t i = first; i < last; ++i) {
            Fan& fan = fans[i];
            if (found.reasons[i] != UndecidedReason::none) continue;
            around.look_from(points, i, neighbours.of(i));
            for (std::size_t j = 0; j < fan.size; ++j) {
                const double scale =
                    std::max({found.scales[i], found.scales[around.number(fan.ring[j])],
                              found.scales[around.number(fan.ring[fan.next(j)])]});
                if (!fan.is_gap(j) && around.circumradius(fan, j) > options.gap_ratio * scale)
                    fan.gaps |= std::uint64_t{1} << j;
            }
            merge_gaps(fan);
            if (!fan.is_umbrella()) {
                found.reasons[i] = UndecidedReason::no_normal;
                continue;
            }
            normals[i] = around.normal(fan);
            found.labels[i] = fan.gaps == 0 ? PointLabel::interior : PointLabel::border;
        }
    });
    found.umbrella_begin.push_back(0);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (found.labels[i] == PointLabel::undecided) {
            found.scales[i] = 0.0;
        } else {
            found.fans.push_back(fans[i]);
            found.normals.push_back(normals[i]);
        }
        found.umbrella_begin.push_back(static_cast<std::uint32_t>(found.fans.size()));
    }
    return found;
}

}  // namespace rimline
