#pragma once

// Best views on a device: how much of their silhouettes is visible, and their pictures.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/measure/visible_ratio.h"
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

namespace rimline::tools {

/// Draws with `pass`, which must outlive it, until Ctrl-C.
VisibleRatios visible_ratios_of(VisibleRatioPass& pass, const Context& context);

/// What `views` and `path` draw with, where they draw: without ratios and pictures they need no device.
struct ViewDevice {
    /// `mesh` must outlive it. Empty unless something `draws`.
    ViewDevice(const std::string& model, const Mesh& mesh, const PictureOptions& options,
               bool draws, const Context& context);

    const DrawingDevice* drawn() const noexcept { return device ? &*device : nullptr; }

    std::optional<DrawingDevice> device;
    std::optional<HoughOctree> octree;
};

/// By `choice`: weighted by ratios that are drawn, or by votes alone.
ChosenViews choose_views(const ViewChoice& choice, const std::string& model, const Mesh& mesh,
                         const ViewDevice& drawn, std::uint32_t least, const Context& context);

/// What a view is drawn with; all of it must outlive the pictures.
struct ViewScene {
    const std::string& model;
    const HoughOctree& octree;
    const SceneOptions& style;
    const PictureOptions& picture;
};

/// One picture for each eye, taken from there: the whole model, its up axis upright. `sun auto` is chosen
/// for each. Throws what renderers throw, and Error{too_large} for a model that reaches too far.
std::vector<Picture> draw_views(Renderer& renderer, const ViewScene& scene,
                                std::span<const glm::dvec3> eyes, ImageSize size,
                                const Context& context);

}  // namespace rimline::tools
