#include "tools/options/scene_options.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/view_defaults.h"
#include "tools/nearest_name.h"
#include "tools/options/option_types.h"
#include "tools/options/picture_scene.h"
#include "tools/options/style_names.h"

namespace rimline::tools {

void SceneOptions::add_to(CLI::App& app) {
    constexpr const char* k_group = "Style";
    app.add_option(
           "--style", style,
           "Drawing style; hatch: pen strokes, mask: white where light arrives, black elsewhere, "
           "no other value")
        ->check(CLI::IsMember(std::vector<std::string>(k_style_names.begin(), k_style_names.end())))
        ->capture_default_str()
        ->group(k_group);
    add_color(
        app, "--color", color,
        "Color of surfaces (default: in ink, toon and hatch that of the model's file; where it "
        "has none, the style's own)")
        ->group(k_group);
    app.add_option("--materials", materials, "Use the colors of the model's file")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str()
        ->group(k_group);
    add_color_or(app, "--line-color", line_color, "material", has_material_lines,
                 "Color of lines, and of strokes in hatch (default: the style's own). material: in "
                 "ink, toon and hatch, a dark shade of the colors of the model's file")
        ->group(k_group);
    app.add_option("--lines", lines,
                   "Draw silhouettes and borders (default: on; off in the style mask)")
        ->check(CLI::IsMember({"on", "off"}))
        ->group(k_group);
    add_number(app, "--line-width", line_width, 0.1, 100.0,
               "Line width in pixels (default: the style's own)")
        ->group(k_group);
    add_number_or(app, "--crease", crease_degrees, 10.0, 180.0, "clear", has_clear_creases,
                  "Draw all edges that bend by at least this angle in degrees; clear: those that "
                  "bend by 30 and stand out (default: clear in ink and blueprint; none in other "
                  "styles)")
        ->group(k_group);
    app.add_flag("--hidden", hidden, "Draw hidden lines too, dashed and fainter")->group(k_group);
    app.add_option("--shadows", shadows,
                   "Method of shadow volumes: depth fail, or for each volume the cheaper of depth "
                   "pass, if that is proved to be right, and depth fail (auto). Both give the same "
                   "picture. off: no shadows")
        ->check(CLI::IsMember({"auto", "fail", "off"}))
        ->capture_default_str()
        ->group(k_group);
    app.add_flag("--ground", ground, "Draw a ground that receives shadows")->group(k_group);
}

void SceneOptions::add_palette_to(CLI::App& app) {
    app.add_option(
           "--palette", palette,
           "Colors of the style, which --color, --line-color and --background replace one by "
           "one. " +
               all_palette_names())
        ->type_name("PALETTE")
        ->group("Style");
}

void SceneOptions::add_exact_lines_to(CLI::App& app) {
    constexpr const char* k_group = "Style";
    app.add_option("--intersections", intersections,
                   "Draw lines where surfaces pass through each other (default: on in ink and "
                   "blueprint)")
        ->check(CLI::IsMember({"on", "off"}))
        ->group(k_group);
    add_number(app, "--min-length", min_length, 0.0, 1000.0,
               "Leave out lines shorter than this many pixels that begin or end away from others "
               "(default: a 60th of the picture's height)")
        ->group(k_group);
}

void SceneOptions::add_frame_lines_to(CLI::App& app) {
    add_exact_lines_to(app);
    app.add_option("--line-visibility", line_visibility,
                   "exact: a line is drawn where no face hides it, as in still pictures; depth: "
                   "edge by edge, where the depth of the surfaces shows it, with specks")
        ->check(CLI::IsMember({"exact", "depth"}))
        ->capture_default_str()
        ->group("Style");
}

LineStyle SceneOptions::line_style(const Palette& shown_palette) const {
    LineStyle shown = line_style();
    if (has_material_lines && shows_colors(style_value()))
        shown.material_shades_are_light = shown_palette.has_light_ink();
    return shown;
}

LineStyle SceneOptions::line_style() const {
    const StyleDefaults defaults = style_defaults(style_value());
    const StyleDefaults creases = has_clear_creases ? style_defaults(Style::ink) : defaults;
    return {
        .crease_degrees = crease_degrees.value_or(double{creases.crease_angle_deg}),
        .all_creases = crease_degrees.has_value(),
        .intersections = intersections ? *intersections == "on" : defaults.crease_angle_deg > 0.0f,
        .hidden = hidden,
        .min_length = min_length};
}

Style SceneOptions::style_value() const { return style_named(style); }

PictureFinish SceneOptions::finish(const PictureOptions& picture) const {
    const std::optional<Color>& under = picture.background;
    const bool is_translucent = under && under->alpha < 255;
    return {.has_alpha = picture.has_no_background || is_translucent,
            .under = is_translucent ? under : std::nullopt,
            .is_mask = style_value() == Style::mask};
}

const NamedPalette* SceneOptions::named_palette() const {
    return find_palette(style_value(), palette);
}

void SceneOptions::check_usage(const PictureOptions& picture) const {
    if (!palette.empty() && palette != own_palette(style_value()) && !named_palette()) {
        std::vector<std::string> names{std::string(own_palette(style_value()))};
        for (const NamedPalette& named : named_palettes())
            if (named.style == style_value()) names.emplace_back(named.name);
        if (names.front().empty())
            throw UsageError("--palette: the style " + style + " has no palettes");
        throw UsageError("--palette: the style " + style + " has " + palette_names(style_value()) +
                         ", not '" + palette + "'" + did_you_mean(palette, names));
    }
    if (picture.has_own_silhouette() && (intersections || min_length))
        throw UsageError(std::string(intersections ? "--intersections" : "--min-length") +
                         ": a frozen silhouette (--silhouette-from, --silhouette-direction) has "
                         "neither intersections nor lines that are too short");
    if (line_visibility == "depth" && (intersections || min_length))
        throw UsageError(std::string(intersections ? "--intersections" : "--min-length") +
                         ": lines have that only with --line-visibility exact");
    if (has_painted_models && has_material_lines && !shows_file_colors())
        throw UsageError(
            "--line-color material: with --paint it takes the colors of files; leave out --color "
            "and --materials off");
    const bool has_own_lights =
        !picture.lights.empty() || picture.suns.size() + (picture.has_chosen_sun ? 1 : 0) > 1;
    if (picture.is_three_point() && has_own_lights)
        throw UsageError("--lighting three-point: takes one --sun and no --light");
    if (style_value() != Style::mask) return;
    const auto check = [](const char* option, const std::optional<Color>& given) {
        constexpr Color k_black{0, 0, 0}, k_white{255, 255, 255};
        if (given && *given != k_black && *given != k_white)
            throw UsageError(std::string(option) +
                             ": the style mask has only the colors black and white");
    };
    check("--color", color);
    check("--line-color", line_color);
    check("--background", picture.background);
}

void SceneOptions::check_lines() const {
    if (draws_lines()) return;
    const auto refuse = [&](const char* option, bool is_given) {
        if (is_given)
            throw UsageError(std::string(option) +
                             (lines ? ": --lines off draws no lines"
                                    : ": the style mask draws lines with --lines on alone"));
    };
    refuse("--line-width", line_width.has_value());
    refuse("--crease", has_creases());
    refuse("--hidden", hidden);
    refuse("--intersections", intersections == "on");
    refuse("--min-length", min_length.has_value());
}

glm::vec3 SceneOptions::background(const PictureOptions& picture) const {
    if (picture.background) return linear_from_srgb(*picture.background);
    if (const NamedPalette* named = named_palette()) return linear_from_srgb(named->background);
    return style_defaults(style_value()).background;
}

glm::vec3 SceneOptions::surface_color(const PictureOptions& picture) const {
    if (color) return linear_from_srgb(*color);
    const NamedPalette* named = named_palette();
    if (named && named->surface) return linear_from_srgb(*named->surface);
    if (named) return background(picture);
    return default_surface_color(style_value(), background(picture));
}

Material SceneOptions::material(const PictureOptions& picture) const {
    Material material{.color = surface_color(picture),
                      .shows_mesh_colors = shows_file_colors() || has_painted_models,
                      .lines_in_mesh_colors = has_material_lines};
    if (line_color) material.line_color = linear_from_srgb(*line_color);
    return material;
}

Scene SceneOptions::make_scene(const Camera& camera, std::vector<Light> lights,
                               const PictureOptions& picture) const {
    const StyleDefaults defaults = style_defaults(style_value());
    const LineStyle shown = line_style();
    const NamedPalette* named = named_palette();
    const glm::vec3 paper = background(picture);
    Scene scene{
        .lights = std::move(lights),
        .camera = camera,
        .style = style_value(),
        .palette = named ? engine_palette(*named, paper) : default_palette(style_value(), paper),
        .has_background = !finish(picture).has_alpha,
        .shadows = shadows != "off",
        .shadow_method = shadows == "fail" ? ShadowMethod::fail : ShadowMethod::automatic,
        .lines = draws_lines(),
        .line_width_px = float(line_width.value_or(defaults.line_width_px)),
        .hidden_line_strength = hidden ? defaults.hidden_line_strength : 0.0f,
        .crease_angle_deg = float(shown.crease_degrees),
        .only_clear_creases = !shown.all_creases};
    return scene;
}

Ground::Ground(const Mesh& mesh, const glm::dvec3& up, double drop)
    : model_(mesh),
      translation_(-drop * glm::normalize(up)),
      mesh_(make_ground(mesh, up, k_ground_end * mesh.radius())),
      octree_(mesh_) {}

SceneInstance Ground::instance(const Scene& scene, double fade_radius) const {
    SceneInstance instance = ground_instance(scene, model_, octree_, fade_radius);
    instance.translation = translation_;
    return instance;
}

void check_scene_reach(const std::string& model, const Mesh& mesh, std::span<const glm::dvec3> eyes,
                       bool ground) {
    // The ground is a square: its corners are farther away than its sides.
    const double radius = (ground ? 1.5 * k_ground_end : 1.0) * mesh.radius();
    glm::dvec3 reach = glm::abs(mesh.center()) + radius;
    for (const glm::dvec3& eye : eyes) reach = glm::max(reach, glm::abs(eye));
    if (std::max({reach.x, reach.y, reach.z}) > double{k_max_coordinate})
        throw Error(ErrorCode::too_large, model + ": too large to stand before" +
                                              (ground ? " or to lay a ground under" : "") +
                                              ": scale it down, coordinates end at 2^60");
}

}  // namespace rimline::tools
