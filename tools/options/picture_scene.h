#pragma once

// Converts the options of a picture into a camera and a scene, so that the same options give the same
// picture in every subcommand.

#include <optional>
#include <string>

#include "engine/scene.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/srgb.h"
#include "tools/options/default_view.h"
#include "tools/options/picture_options.h"

namespace rimline::tools {

/// Extent of a ground in the model's radii: it has faded out at the first and ends at the second.
constexpr double k_ground_fade = 7.0;
constexpr double k_ground_end = 8.0;

using rimline::linear_from_srgb;
glm::vec3 linear_from_srgb(const Color& color);
/// The nearest opaque color, of a color in linear light.
Color nearest_srgb(const glm::vec3& linear);

/// --up, or the up axis of the file format.
glm::dvec3 up_of(const Subject& subject, const PictureOptions& options);

/// --ground-up, or up_of().
glm::dvec3 ground_up_of(const Subject& subject, const PictureOptions& options);

/// Rounds eye, target and up as options are parsed, so that a camera which is printed and given again draws the
/// same picture. Unchanged if eye and target would coincide.
Camera rounded_to_float(const Camera& camera);

/// The camera of the options, rounded_to_float(). Without --eye, one that shows the whole model; with --eye and
/// without --target and --fov too, unless the model reaches beside or behind the eye. `model` is the model's
/// name: the built-in scene has its own view direction. ViewOption::choose() comes before, or a chosen view is
/// the default one. Throws UsageError if eye and target coincide.
Camera make_camera(const Subject& subject, const std::string& model, const PictureOptions& options);

/// Whether all of the mesh lies on the outer side of one side of the view, or behind the viewer. O(vertices).
bool is_out_of_view(const Mesh& mesh, const Camera& camera, double aspect);

/// The camera of --silhouette-from, which is `from` in the subject's coordinates, or of --silhouette-direction; nothing
/// without both. `camera` is that of the picture. Throws UsageError if `from` is the subject's center.
std::optional<Camera> silhouette_camera_of(const Subject& subject, const Camera& camera,
                                           const std::optional<glm::dvec3>& from,
                                           const PictureOptions& options);

/// An instance of the mesh make_ground(mesh, up, k_ground_end * radius), of which `octree` is the octree. It
/// receives shadows in the style, the palette and the line color of `scene`; without a background only these
/// are drawn, black.
SceneInstance ground_instance(const Scene& scene, const Mesh& mesh, const HoughOctree& octree,
                              double fade_radius);

}  // namespace rimline::tools
