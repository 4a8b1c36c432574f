#pragma once

// The scene of one picture of a model, as `render` draws it: camera, lights and ground are those of the options, or
// chosen for the model.

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "engine/scene.h"
#include "silhouette/hough/hough_octree.h"
#include "tools/options/picture_options.h"
#include "tools/options/scene_options.h"
#include "tools/output/shown_lines.h"

namespace rimline::tools {

class StillScene {
public:
    /// `name` is the model's, `octree` that of its mesh; both must outlive this object. ViewOption::choose() comes
    /// before, and so does up_option.h. Throws UsageError if eye and target coincide, Error{too_large} if the scene
    /// leaves the range of coordinates, Error{cancelled}.
    StillScene(const std::string& name, const HoughOctree& octree, const SceneOptions& style,
               const PictureOptions& picture, const LongCall& call);
    StillScene(const StillScene&) = delete;
    StillScene& operator=(const StillScene&) = delete;

    /// Whether its lines can have exact visibility: it has some, and they are the camera's own.
    bool has_exact_lines() const noexcept { return scene_.lines && !scene_.silhouette_camera; }
    /// Gives the model such lines, if it can have them. `lines` is of the same octree, and draws nothing else until
    /// the picture is drawn.
    void add_lines(ShownLines& lines, const LongCall& call);

    /// The model is its first instance.
    const Scene& scene() const noexcept { return scene_; }
    const glm::dvec3& ground_up() const noexcept { return ground_up_; }

private:
    const SceneOptions& style_;
    const PictureOptions& picture_;
    Scene scene_;
    glm::dvec3 ground_up_;
    std::optional<Ground> ground_;
};

}  // namespace rimline::tools
