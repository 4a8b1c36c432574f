#pragma once

// Pictures of meshes for other languages, with the options of `rimline render`.

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/field/best_views.h"
#include "silhouette/picture.h"
#include "tools/bindings/bound_mesh.h"
#include "tools/bindings/turns.h"
#include "tools/options/drawing_device.h"
#include "tools/options/picture_options.h"
#include "tools/options/scene_options.h"
#include "tools/output/shown_lines.h"

namespace rimline::tools {

/// The options of style, camera, lights and image.
struct RenderOptions {
    RenderOptions();

    CLI::App app;  ///< Parses into the others.
    SceneOptions style;
    PictureOptions picture;
};

/// A device and what is kept on it. Threads that share one take turns.
class BoundRenderer {
public:
    /// `device` as --device. Throws Error{no_device}.
    BoundRenderer(const std::string& device, bool validates);

    /// Throws UsageError for a mesh that is not welded and for options that do not go together, and as Turns and
    /// Renderer.
    Picture render(const SharedMesh& mesh, RenderOptions& options, const LongCall& call);
    /// Calls use(ratios) while no other thread uses the device.
    void measure(BoundMesh& mesh, const LongCall& call,
                 const std::function<void(const VisibleRatios& ratios)>& use);

    const DrawingDevice& device() const noexcept { return device_; }

private:
    DrawingDevice device_;
    Turns turns_;
    // The renderer knows octrees by their addresses: those of the last picture, and of pictures that failed after it.
    // So these meshes live until another picture has been drawn.
    std::vector<SharedMesh> meshes_;
    std::optional<ShownLines> lines_;  // Of one of these.
    std::optional<Renderer> renderer_;
};

/// Calls use(ratios) with those that `renderer` measures; without one, with those of rays (ray_ratios.h), which need no
/// device.
void measure_views(BoundMesh& mesh, BoundRenderer* renderer, const LongCall& call,
                   const std::function<void(const VisibleRatios& ratios)>& use);

}  // namespace rimline::tools
