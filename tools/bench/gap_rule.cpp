#include "tools/bench/gap_rule.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/mesh/any_perpendicular.h"
#include "silhouette/points/each_point.h"
#include "silhouette/points/neighbor_lists.h"
#include "silhouette/points/neighborhood.h"

namespace rimline::tools {

std::vector<double> widest_sectors(std::span<const glm::dvec3> positions) {
    constexpr std::uint32_t k_neighbors = 16;
    const LongCall call;
    const NeighborLists neighbors(positions, k_neighbors, call);
    std::vector<double> widest(positions.size(), 2.0 * std::numbers::pi);
    each_point(
        static_cast<std::uint32_t>(positions.size()), {call},
        [&](std::uint32_t first, std::uint32_t last) {
            Neighborhood around;
            std::vector<double> angles;
            for (std::uint32_t i = first; i < last; ++i) {
                around.assign(positions, i, neighbors.of(i).first(neighbors.nearest_count()));
                const glm::dvec3 n = around.fitted_normal(around.size());
                if (n == glm::dvec3(0.0)) continue;
                const glm::dvec3 u = any_perpendicular(n);
                const glm::dvec3 v = glm::cross(n, u);
                angles.clear();
                for (std::uint32_t j = 0; j < around.size(); ++j)
                    angles.push_back(
                        std::atan2(glm::dot(around.edge(j), v), glm::dot(around.edge(j), u)));
                std::sort(angles.begin(), angles.end());
                double greatest = angles.front() + 2.0 * std::numbers::pi - angles.back();
                for (std::size_t j = 1; j < angles.size(); ++j)
                    greatest = std::max(greatest, angles[j] - angles[j - 1]);
                widest[i] = greatest;
            }
        });
    return widest;
}

}  // namespace rimline::tools
