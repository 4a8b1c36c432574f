#pragma once

// Where an instance's silhouettes are seen from: cameras and lights in the instance's own coordinates.
//
// They are transformed there once, in double, and rounded to float there. So the point that a tracker
// follows, the point that a volume is extruded from, and the point that vertices are taken relative to are
// the same float.

#include <glm/vec3.hpp>

#include "engine/camera.h"
#include "engine/frame/caster_mesh.h"
#include "engine/scene.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// Whether an instance's lines are drawn.
bool has_lines(const Scene& scene, const SceneInstance& instance);
/// Whether these lines are its silhouette from the camera: the caller gives no others.
bool has_silhouette_lines(const Scene& scene, const SceneInstance& instance);
/// Whether its shadow is drawn.
bool casts_shadows(const Scene& scene, const SceneInstance& instance);
bool casts_shadows(const Scene& scene, const SceneInstance& instance, const Light& light);

/// A point of the world, and a direction, in the instance's coordinates.
glm::dvec3 point_in_object(const SceneInstance& instance, const glm::dvec3& world);
glm::dvec3 direction_in_object(const SceneInstance& instance, const glm::dvec3& world);

/// The camera whose silhouettes are drawn as lines: the scene's camera, unless lines are frozen.
const Camera& lines_camera(const Scene& scene);

/// Silhouette points in the instance's coordinates.
HomogeneousPoint camera_point(const SceneInstance& instance, const Camera& camera);
HomogeneousPoint light_point(const SceneInstance& instance, const Light& light);
/// light_point(), moved off the vertices (light_off_vertices()) where the instance casts shadows. `casters` must
/// have its mesh if that does not deform.
HomogeneousPoint casting_point(const Scene& scene, const SceneInstance& instance,
                               const Light& light, const CasterMeshes& casters);

}  // namespace rimline
