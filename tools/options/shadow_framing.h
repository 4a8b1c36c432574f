#pragma once

// The frame of a picture with a ground: wide enough for the shadow, too.

#include <glm/vec3.hpp>
#include <span>

#include "engine/scene.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// Shadows farther from the middle of the mesh than this many of its radii may be cut off by the frame.
constexpr double k_framed_shadow_radii = 3.0;

/// The perspective camera, with its direction and lens, at a place where the picture holds the mesh and its
/// shadows from all suns on a ground under it. Shadows of lamps do not count. Rounded to float (view_camera.h).
/// O(vertices) for each sun.
Camera frame_with_shadows(const Camera& camera, const Mesh& mesh, std::span<const Light> lights,
                          const glm::dvec3& ground_up, double aspect);

}  // namespace rimline::tools
