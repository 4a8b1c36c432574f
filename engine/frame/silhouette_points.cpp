#include "engine/frame/silhouette_points.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "silhouette/hough/hough_octree.h"

namespace rimline {

bool has_lines(const Scene& scene, const SceneInstance& instance) {
    return scene.lines && instance.has_lines;
}
bool has_silhouette_lines(const Scene& scene, const SceneInstance& instance) {
    return has_lines(scene, instance) && instance.picture_lines == nullptr;
}
bool casts_shadows(const Scene& scene, const SceneInstance& instance) {
    return scene.shadows && instance.casts_shadows;
}
bool casts_shadows(const Scene& scene, const SceneInstance& instance, const Light& light) {
    return casts_shadows(scene, instance) && light.casts_shadows;
}

glm::dvec3 point_in_object(const SceneInstance& instance, const glm::dvec3& world) {
    return glm::transpose(instance.rotation) * (world - instance.translation) / instance.scale;
}
glm::dvec3 direction_in_object(const SceneInstance& instance, const glm::dvec3& world) {
    return glm::transpose(instance.rotation) * world;
}

const Camera& lines_camera(const Scene& scene) {
    return scene.silhouette_camera ? *scene.silhouette_camera : scene.camera;
}

HomogeneousPoint camera_point(const SceneInstance& instance, const Camera& camera) {
    if (!camera.is_orthographic())
        return HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, camera.eye)));
    return HomogeneousPoint::direction(
        glm::vec3(direction_in_object(instance, glm::normalize(camera.eye - camera.target))));
}

HomogeneousPoint light_point(const SceneInstance& instance, const Light& light) {
    if (!light.directional)
        return HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, light.vector)));
    return HomogeneousPoint::direction(
        glm::vec3(direction_in_object(instance, glm::normalize(light.vector))));
}

HomogeneousPoint casting_point(const Scene& scene, const SceneInstance& instance,
                               const Light& light, const CasterMeshes& casters) {
    const HomogeneousPoint point = light_point(instance, light);
    if (!casts_shadows(scene, instance, light) || instance.deforming || point.is_direction())
        return point;
    return light_off_vertices(casters.at(&instance.octree->mesh()).vertices(), point);
}

}  // namespace rimline
