#include "engine/scene.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace rimline {

SceneBounds bounds_of(const Scene& scene) {
    glm::dvec3 low(0.0);
    glm::dvec3 high(0.0);
    bool first = true;
    for (const SceneInstance& instance : scene.instances) {
        const Mesh& mesh = instance.octree->mesh();
        const glm::dvec3 center = instance.rotation * mesh.center() + instance.translation;
        low = first ? center - mesh.radius() : glm::min(low, center - mesh.radius());
        high = first ? center + mesh.radius() : glm::max(high, center + mesh.radius());
        first = false;
    }
    // Around the spheres' box, not its corners: each sphere reaches no farther than this.
    SceneBounds bounds{.center = 0.5 * (low + high), .radius = 0.0};
    for (const SceneInstance& instance : scene.instances) {
        const Mesh& mesh = instance.octree->mesh();
        const glm::dvec3 center = instance.rotation * mesh.center() + instance.translation;
        bounds.radius =
            std::max(bounds.radius, glm::distance(center, bounds.center) + mesh.radius());
    }
    if (bounds.radius == 0.0) bounds.radius = 1.0;
    return bounds;
}

}  // namespace rimline
