#pragma once

// From the options of a picture to what is drawn, so that the same options give the same picture in
// every subcommand.

#include <string>

#include "engine/scene.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/mesh.h"
#include "tools/options/picture_options.h"

namespace rimline::tools {

/// What is drawn where no model is named.
constexpr const char* k_default_model = "shape:scene";

/// Of a ground, in the model's radii: where it has faded out, and where it ends.
constexpr double k_ground_fade = 7.0;
constexpr double k_ground_end = 8.0;

glm::vec3 linear_from_srgb(const Color& color);
/// Of channels in [0, 1].
glm::vec3 linear_from_srgb(const glm::vec3& srgb);
glm::vec3 srgb_from_linear(const glm::vec3& linear);

/// --up, or what the format says.
glm::dvec3 up_of(const Subject& subject, const PictureOptions& options);

/// The camera of the options; where they leave it open, one that shows the whole model. `model` is its
/// name: the built-in scene has a view of its own. Throws UsageError where eye and target coincide.
Camera make_camera(const Subject& subject, const std::string& model, const PictureOptions& options);

/// An instance of make_ground(mesh, up, k_ground_end * radius), indexed by `octree`, that catches shadows
/// in the style and the palette of `scene`.
SceneInstance ground_instance(const Scene& scene, const Mesh& mesh, const HoughOctree& octree);

}  // namespace rimline::tools
