#pragma once

// The options of style, lines, shadows and ground, and the scene that follows from these and from the
// options of camera, lights and image.

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene.h"
#include "silhouette/hough/hough_octree.h"
#include "tools/cli_classes.h"
#include "tools/options/line_style.h"
#include "tools/options/model_argument.h"
#include "tools/options/palettes.h"
#include "tools/options/picture_finish.h"
#include "tools/options/picture_options.h"

namespace rimline::tools {

struct SceneOptions {
    std::string style = "ink";
    // Values that are not set are the style's own.
    std::optional<Color> color;  ///< Of surfaces.
    std::optional<Color> line_color;
    bool has_material_lines = false;  ///< Lines have shades of the materials of their faces.
    std::string palette;
    std::string materials = "on";
    std::optional<std::string> lines;  ///< on or off.
    std::optional<double> line_width;  ///< In pixels.
    std::optional<double> crease_degrees;
    bool has_clear_creases = false;  ///< Those that stand out (clear_creases.h), in any style.
    std::optional<std::string> intersections;  ///< on or off.
    std::optional<double> min_length;          ///< Of lines with exact visibility, in pixels.
    std::string line_visibility = "exact";     ///< Of animations: exact or depth.
    bool hidden = false;
    std::string shadows = "auto";
    bool ground = false;
    bool has_painted_models = false;  ///< Not an option: the mesh has colors of --paint.

    void add_to(CLI::App& app);
    /// --palette, which the window does not have.
    void add_palette_to(CLI::App& app);
    /// Options of lines with exact visibility.
    void add_exact_lines_to(CLI::App& app);
    /// The same, of animations, which can do without.
    void add_frame_lines_to(CLI::App& app);

    /// A scene in this style with this camera and these lights (scene_lights.h), and no instances.
    Scene make_scene(const Camera& camera, std::vector<Light> lights,
                     const PictureOptions& picture) const;
    /// For lines of exact visibility in a scene with this palette.
    LineStyle line_style(const Palette& shown_palette) const;
    bool draws_exact_lines() const { return draws_lines() && line_visibility == "exact"; }
    bool draws_lines() const { return lines ? *lines == "on" : style != "mask"; }
    /// What is left to do with the pictures of such a scene.
    PictureFinish finish(const PictureOptions& picture) const;
    /// Throws UsageError for a palette that the style does not have, for colors in the style mask, which is black
    /// and white, and for options without an effect.
    void check_usage(const PictureOptions& picture) const;
    /// Throws UsageError for options of lines but their color where none are drawn. Not for the window, where they can
    /// be drawn later.
    void check_lines() const;
    /// Whether surfaces have the colors of the model's file, if it has some.
    bool shows_file_colors() const { return materials == "on" && !color; }
    TexturePictures textures() const {
        return shows_file_colors() || has_material_lines ? TexturePictures::read
                                                         : TexturePictures::skip;
    }
    /// The material of the model.
    Material material(const PictureOptions& picture) const;
    /// Whether creases are not the style's own.
    bool has_creases() const noexcept { return has_clear_creases || crease_degrees.has_value(); }

private:
    LineStyle line_style() const;
    Style style_value() const;
    const NamedPalette* named_palette() const;
    glm::vec3 background(const PictureOptions& picture) const;
    glm::vec3 surface_color(const PictureOptions& picture) const;
};

/// A ground under a mesh. Owns the mesh and the octree of its instance.
class Ground {
public:
    /// The ground lies just below the lowest vertex, and `drop` lower, as space for a mesh that deforms.
    /// `mesh` must outlive this object.
    Ground(const Mesh& mesh, const glm::dvec3& up, double drop);
    Ground(const Ground&) = delete;
    Ground& operator=(const Ground&) = delete;

    SceneInstance instance(const Scene& scene, double fade_radius) const;

private:
    const Mesh& model_;
    glm::dvec3 translation_;
    Mesh mesh_;
    HoughOctree octree_;
};

/// Throws Error{too_large} if the eyes, the model or its ground exceed the range of coordinates.
void check_scene_reach(const std::string& model, const Mesh& mesh, std::span<const glm::dvec3> eyes,
                       bool ground);

}  // namespace rimline::tools
