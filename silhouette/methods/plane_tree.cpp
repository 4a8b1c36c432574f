#include "silhouette/methods/plane_tree.h"

namespace rimline {

namespace {

PlacedPlane in_plane_space(const Plane& plane, const glm::dvec3& center) {
    const auto [distance, error] = offset_plane(plane, center);
    return {{{plane.nx, plane.ny, plane.nz, distance - error},
             {plane.nx, plane.ny, plane.nz, distance + error}},
            1};
}

}  // namespace

PlaneTree::PlaneTree(const Mesh& mesh)
    : space_(mesh, mesh.center(),
             [center = mesh.center()](const Plane& plane) { return in_plane_space(plane, center); },
             {1.0, 1.0, 1.0, mesh.radius() > 0.0 ? 1.0 / mesh.radius() : 0.0}) {}

void PlaneTree::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                        TraversalCounters& counters) {
    space_.extract(point, edges, counters);
}

void PlaneTree::update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                       TraversalCounters& counters) {
    space_.update(point, edges, counters);
}

}  // namespace rimline
