#include "engine/scene.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "silhouette/hough/hough_octree.h"

namespace rimline {

const Mesh& SceneInstance::mesh() const noexcept {
    RIMLINE_CHECK(deforming != nullptr || octree != nullptr);
    return deforming ? *deforming : octree->mesh();
}

BoundingSphere SceneInstance::bounds() const {
    if (deforming) return bounding_sphere(*deforming, deformation);
    return {mesh().center(), mesh().radius()};
}

glm::dvec3 point_in_world(const SceneInstance& instance, const glm::dvec3& point) {
    return instance.rotation * (instance.scale * point) + instance.translation;
}

SceneBounds bounds_of(const Scene& scene) {
    glm::dvec3 low(0.0);
    glm::dvec3 high(0.0);
    bool first = true;
    const auto in_world = [](const SceneInstance& instance) {
        const BoundingSphere sphere = instance.bounds();
        return BoundingSphere{point_in_world(instance, sphere.center),
                              instance.scale * sphere.radius};
    };
    for (const SceneInstance& instance : scene.instances) {
        const auto [center, radius] = in_world(instance);
        low = first ? center - radius : glm::min(low, center - radius);
        high = first ? center + radius : glm::max(high, center + radius);
        first = false;
    }
    // Around the spheres themselves, not the corners of their box: a smaller sphere.
    SceneBounds bounds{.center = 0.5 * (low + high), .radius = 0.0};
    for (const SceneInstance& instance : scene.instances) {
        const auto [center, radius] = in_world(instance);
        bounds.radius = std::max(bounds.radius, glm::distance(center, bounds.center) + radius);
    }
    if (bounds.radius == 0.0) bounds.radius = 1.0;
    return bounds;
}

}  // namespace rimline
