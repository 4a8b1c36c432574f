#pragma once

// Best views on a device: the visible ratios of their silhouettes, and their pictures.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/field/best_views.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/picture.h"
#include "tools/command.h"
#include "tools/options/drawing_device.h"
#include "tools/options/option_types.h"
#include "tools/options/picture_options.h"
#include "tools/options/scene_options.h"
#include "tools/options/view_choice.h"
#include "tools/output/shown_lines.h"

namespace rimline::tools {

/// The device and the octree of `views` and `path`. Without ratios and pictures these need no device.
struct ViewDevice {
    /// Both members are empty unless `draws`. `mesh` must outlive this object.
    ViewDevice(const std::string& model, const Mesh& mesh, const PictureOptions& options,
               bool draws, const Context& context);

    const DrawingDevice* device_or_null() const noexcept { return device ? &*device : nullptr; }

    std::optional<DrawingDevice> device;
    std::optional<HoughOctree> octree;
};

/// Chooses views. Votes are weighted by visible ratios unless choice.no_ratio.
ChosenViews choose_views(const ViewChoice& choice, const std::string& model, const Mesh& mesh,
                         const glm::dvec3& up, const ViewDevice& view_device,
                         std::uint32_t min_count, const Context& context);

/// The model and the options of pictures of views.
struct ViewScene {
    const std::string& model;
    const HoughOctree& octree;
    const SceneOptions& style;
    const PictureOptions& picture;
    ShownLines* lines = nullptr;  ///< Null: without exact visibility.
};

/// An eye, and the lights of its picture.
struct LightedView {
    glm::dvec3 eye;
    std::vector<Light> lights;
};

/// The camera of a view's picture: it stands at `eye` and shows the whole model in a picture of this size.
Camera make_view_camera(const Mesh& mesh, const glm::dvec3& eye, const PictureOptions& options,
                        ImageSize size);
/// The scene of a view's picture, without instances. With a ground the picture holds the shadows too
/// (shadow_framing.h).
Scene make_view_scene(const Mesh& mesh, const LightedView& view, const SceneOptions& style,
                      const PictureOptions& options, ImageSize size);

/// One picture per view, from make_view_scene(). Each shows the whole model with its up axis upwards. Throws
/// what Renderer throws, and Error{too_large} if the model exceeds the range of coordinates.
std::vector<Picture> draw_views(Renderer& renderer, const ViewScene& scene,
                                std::span<const LightedView> views, ImageSize size,
                                const Context& context);

}  // namespace rimline::tools
