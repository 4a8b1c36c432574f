#include "silhouette/methods/gauss_map.h"

#include <algorithm>
#include <cmath>

namespace rimline {

namespace {

PlacedPlane on_cube(const Plane& plane) {
    const std::array<double, 3> n{plane.nx, plane.ny, plane.nz};
    const double greatest = std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
    PlacedPlane placed;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = n[k] / greatest;
        const double spread = std::abs(at) * 0x1p-52;
        placed.bounds.low[k] = at - spread;
        placed.bounds.high[k] = at + spread;
    }
    placed.bounds.low[3] = placed.bounds.high[3] = 0.0;
    placed.factor_sign = 1;
    return placed;
}

void refuse_viewpoint(const HomogeneousPoint& point) {
    if (!point.is_direction())
        throw Error(ErrorCode::bad_input, "the Gauss map takes directions only, no viewpoints");
}

}  // namespace

GaussMap::GaussMap(const Mesh& mesh)
    : space_(mesh, glm::dvec3(0.0), on_cube, {1.0, 1.0, 1.0, 0.0}) {}

void GaussMap::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                       TraversalCounters& counters) {
    refuse_viewpoint(point);
    space_.extract(point, edges, counters);
}

void GaussMap::update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                      TraversalCounters& counters) {
    refuse_viewpoint(point);
    space_.update(point, edges, counters);
}

}  // namespace rimline
