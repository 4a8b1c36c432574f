#pragma once

// The frame of a picture with a ground: wide enough for the shadow, too.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/scene.h"
#include "silhouette/mesh/mesh.h"
#include "tools/options/animation.h"
#include "tools/options/picture_options.h"

namespace rimline::tools {

/// Shadows farther from the middle of the mesh than this many of its radii are not held by the frame. They fade out
/// before: fade_of_ground().
constexpr double k_framed_shadow_radii = 3.0;

/// The places of the shadows of `positions` from all lights that cast shadows, on a ground under the mesh. Places
/// farther away than k_framed_shadow_radii are left out. O(positions) for each light.
std::vector<glm::vec3> shadow_places(const Mesh& mesh, std::span<const glm::vec3> positions,
                                     std::span<const Light> lights, const glm::dvec3& ground_up);

/// The radius in which a ground fades out (SceneInstance::fade_radius): k_ground_fade radii of the mesh; if a
/// shadow is not within k_framed_shadow_radii, these. O(vertices) for each light.
double fade_of_ground(const Mesh& mesh, std::span<const Light> lights, const glm::dvec3& ground_up);

/// The perspective camera, with its direction and lens, at a place where the picture holds the mesh and its
/// shadow_places(). Unchanged below the ground, which is seen from above only. Rounded to float (view_camera.h).
/// O(vertices) for each sun.
Camera frame_with_shadows(const Camera& camera, const Mesh& mesh, std::span<const Light> lights,
                          const glm::dvec3& ground_up, double aspect);

/// The same for a scene with a ground, where its shadows are drawn and the command has placed the camera, or chosen
/// where a given eye looks: then as zoom_with_shadows().
void frame_ground(Scene& scene, const Mesh& mesh, const PictureOptions& options);

/// The perspective camera, at its place, turned and with a lens such that the picture holds the mesh and its
/// shadow_places(), but for those that it sees at more than 60 degrees. Unchanged below the ground, and if the mesh
/// itself reaches beside or behind the eye. Rounded to float. O(vertices) for each sun.
Camera zoom_with_shadows(const Camera& camera, const Mesh& mesh, std::span<const Light> lights,
                         const glm::dvec3& ground_up, double aspect);

// For animations: one frame for all pictures, so that the mesh does not change its size from one to the next.
// The outline of the mesh is about a hundred of its vertices. Shadows at more than 60 degrees from the view do
// not count.

/// The factor, from 1 to 4, by which the distances of all cameras from their targets must grow, so that the
/// pictures hold the shadows with a margin of 6%. O(vertices + shots).
double distance_for_shadows(std::span<const Shot> shots, const Mesh& mesh,
                            const glm::dvec3& ground_up, double aspect);
/// The tangent of half the vertical field of view with which they hold the shadows, with the same margin; 0 without
/// shadows.
double tangent_for_shadows(std::span<const Shot> shots, const Mesh& mesh,
                           const glm::dvec3& ground_up, double aspect);

}  // namespace rimline::tools
