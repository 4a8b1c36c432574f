#pragma once

// The lines of a model in the frames of an animation, with exact visibility, as a still picture has them.

#include <optional>

#include "engine/scene.h"
#include "engine/silhouette_changes.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "tools/options/option_types.h"
#include "tools/options/scene_options.h"
#include "tools/output/shown_lines.h"

namespace rimline::tools {

class FrameLines {
public:
    /// Finds the contacts of faces, with progress. `octree` and `style` must outlive this object.
    FrameLines(const HoughOctree& octree, const SceneOptions& style, ImageSize size,
               const Context& context);

    /// Gives the first instance, which shows the octree's mesh, the lines of this frame, which are valid until the next
    /// call. Throws Error{cancelled}.
    void add_to(Scene& scene, const LongCall& call);
    /// Of the camera's silhouette since the frame before, as the engine reports them where it draws the lines.
    const SilhouetteChanges& changes() const noexcept { return changes_; }

private:
    void follow(const HomogeneousPoint& point);

    const HoughOctree& octree_;
    const SceneOptions& style_;
    ImageSize size_;
    ShownLines lines_;
    std::optional<SilhouetteTracker> tracker_;
    SilhouetteChanges changes_;
};

}  // namespace rimline::tools
