#include "silhouette/methods/dual_tree.h"

#include <algorithm>
#include <cmath>

namespace rimline {

namespace {

// With e the error of the distance and |distance| > 2e, 1/(distance ± e) is within 2e/|distance| of
// 1/distance; 2^-50 covers the roundings of the quotient itself.
PlacedPlane dual_of(const Plane& plane, const glm::dvec3& origin) {
    const auto [distance, error] = offset_plane(plane, origin);
    const double size = std::abs(distance);
    if (!(size > 2.0 * error)) return {};
    const std::array<double, 3> point{plane.nx / distance, plane.ny / distance,
                                      plane.nz / distance};
    constexpr double k_farthest = 0x1p60;  // Products with a point's coordinates stay finite.
    PlacedPlane dual;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::abs(point[k]) <= k_farthest)) return {};
        const double spread = std::abs(point[k]) * (2.0 * error / size + 0x1p-50);
        dual.bounds.low[k] = point[k] - spread;
        dual.bounds.high[k] = point[k] + spread;
    }
    dual.bounds.low[3] = dual.bounds.high[3] = 1.0;
    dual.factor_sign = distance > 0.0 ? 1 : -1;
    return dual;
}

}  // namespace

DualTree::DualTree(const Mesh& mesh, const glm::dvec3& origin)
    : space_(mesh, origin, [origin](const Plane& plane) { return dual_of(plane, origin); },
             {1.0, 1.0, 1.0, 0.0}) {
    for (int i = 0; i < 3; ++i) RIMLINE_CHECK(std::abs(origin[i]) <= double{k_max_coordinate});
}

void DualTree::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                       TraversalCounters& counters) {
    space_.extract(point, edges, counters);
}

void DualTree::update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                      TraversalCounters& counters) {
    space_.update(point, edges, counters);
}

std::vector<NamedCount> DualTree::own_counts() const {
    return {{"edges_through_infinity", space_.untreed_edges()}};
}

}  // namespace rimline
