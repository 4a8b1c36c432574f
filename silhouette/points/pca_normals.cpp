#include "silhouette/points/pca_normals.h"

#include "silhouette/points/each_point.h"
#include "silhouette/points/neighbor_lists.h"
#include "silhouette/points/neighborhood.h"
#include "silhouette/points/point_order.h"

namespace rimline {

std::vector<glm::dvec3> pca_normals(std::span<const glm::dvec3> positions, std::uint32_t k,
                                    const LongCall& call) {
    RIMLINE_CHECK(k >= 4 && k <= 32);
    const OrderedPoints ordered = order_points(positions, call.stop);
    const NeighborLists neighbors(ordered.positions, k, {call.stop, {}});
    std::vector<glm::dvec3> normals(positions.size(), glm::dvec3(0.0));
    const auto count = static_cast<std::uint32_t>(ordered.positions.size());
    each_point(count, {call}, [&](std::uint32_t first, std::uint32_t last) {
        Neighborhood neighborhood;
        for (std::uint32_t i = first; i < last; ++i) {
            neighborhood.assign(ordered.positions, i, neighbors.of(i));
            if (neighborhood.is_collinear()) continue;
            normals[ordered.numbers[i]] = neighborhood.fitted_normal(neighbors.nearest_count());
        }
    });
    return normals;
}

}  // namespace rimline
