#pragma once

// The frame of a picture with a ground: wide enough for the shadow, too.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/scene.h"
#include "silhouette/mesh/mesh.h"
#include "tools/options/animation.h"

namespace rimline::tools {

/// Shadows farther from the middle of the mesh than this many of its radii may be cut off by the frame.
constexpr double k_framed_shadow_radii = 3.0;

/// The places of the shadows of `positions` from all suns on a ground under the mesh. Those of lamps, of suns lower than
/// 3 degrees, and those farther away than k_framed_shadow_radii are left out. O(positions) for each sun.
std::vector<glm::vec3> shadow_places(const Mesh& mesh, std::span<const glm::vec3> positions,
                                     std::span<const Light> lights, const glm::dvec3& ground_up);

/// The perspective camera, with its direction and lens, at a place where the picture holds the mesh and its
/// shadow_places(). Rounded to float (view_camera.h). O(vertices) for each sun.
Camera frame_with_shadows(const Camera& camera, const Mesh& mesh, std::span<const Light> lights,
                          const glm::dvec3& ground_up, double aspect);

/// The perspective camera, at its place, turned and with a lens such that the picture holds the mesh and its
/// shadow_places(), but for those outside a field of view of 90 degrees. Unchanged if the mesh itself reaches beside or
/// behind the eye. Rounded to float. O(vertices) for each sun.
Camera zoom_with_shadows(const Camera& camera, const Mesh& mesh, std::span<const Light> lights,
                         const glm::dvec3& ground_up, double aspect);

// For animations: one frame for all pictures, so that the mesh does not change its size from one to the next. The outline
// of the mesh is about a hundred of its vertices. Shadows outside a field of view of 90 degrees do not count.

/// The factor, from 1 to 4, by which the distances of all cameras from their targets must grow, so that the pictures hold
/// the shadows with a margin of 6%. O(vertices + shots).
double distance_for_shadows(std::span<const Shot> shots, const Mesh& mesh,
                            const glm::dvec3& ground_up, double aspect);
/// The tangent of half the vertical field of view with which they hold the shadows, with the same margin; 0 without
/// shadows.
double tangent_for_shadows(std::span<const Shot> shots, const Mesh& mesh,
                           const glm::dvec3& ground_up, double aspect);

}  // namespace rimline::tools
