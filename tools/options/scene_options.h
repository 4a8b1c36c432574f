#pragma once

// The options that say what is drawn and how, beside camera, lights and image, and the scene that follows
// from all of them.

#include <CLI/App.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "engine/scene.h"
#include "silhouette/hough/hough_octree.h"
#include "tools/options/picture_options.h"

namespace rimline::tools {

struct SceneOptions {
    std::string style = "ink";
    std::optional<Color>
        color;  ///< Of surfaces. This and that of lines: the style's own if not given.
    std::optional<Color> line_color;
    std::string lines = "on";
    std::optional<double>
        line_width;  ///< In pixels. This and creases: the style's own if not given.
    std::optional<double> crease_degrees;
    bool hidden = false;
    std::string shadows = "auto";
    bool ground = false;

    void add_to(CLI::App& app);

    /// A scene in this style, seen from `camera`, with the lights of `picture`: no instances yet. `mesh` is
    /// what a sun is chosen for.
    Scene make_scene(const Camera& camera, const Mesh& mesh, const PictureOptions& picture) const;
    /// Of the model.
    Material material(const PictureOptions& picture) const;

private:
    Style style_value() const;
    glm::vec3 background(const PictureOptions& picture) const;
};

/// The direction of a sun, and where that is lower than 15 degrees above a ground, or below it, the nearest
/// that is not.
glm::dvec3 above_ground(const glm::dvec3& sun, const glm::dvec3& up);

/// A ground under a mesh, so low that it holds `drop` more below; keeps what its instance refers to.
class Ground {
public:
    Ground(const Mesh& mesh, const glm::dvec3& up, double drop);
    Ground(const Ground&) = delete;
    Ground& operator=(const Ground&) = delete;

    SceneInstance instance(const Scene& scene) const;

private:
    const Mesh& model_;
    glm::dvec3 translation_;
    Mesh mesh_;
    HoughOctree octree_;
};

/// Throws Error{too_large} where the eyes, the model or its ground lie beyond the coordinates that
/// silhouettes are found in.
void check_scene_reach(const std::string& model, const Mesh& mesh, std::span<const glm::dvec3> eyes,
                       bool ground);

}  // namespace rimline::tools
