#include "tools/view/view_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "engine/view_defaults.h"
#include "silhouette/lines/fitted_eye.h"
#include "silhouette/mesh/ground_axes.h"
#include "tools/options/model_list.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/style_names.h"
#include "tools/options/three_point.h"
#include "tools/options/view_camera.h"
#include "tools/output/camera_report.h"
#include "tools/output/same_picture.h"
#include "tools/view/camera_motion.h"
#include "tools/view/light_handles.h"
#include "tools/view/screen_view.h"

namespace rimline::tools {

namespace {

std::string hex_of(const glm::vec3& linear) {
    const Color color = nearest_srgb(linear);
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", color.red, color.green, color.blue);
    return text.data();
}

// What render refuses where there are no lines (SceneOptions::check_lines()).
void add_lines(nlohmann::ordered_json& json, const ViewAppearance& appearance) {
    const StyleDefaults defaults = style_defaults(appearance.style);
    if (appearance.line_width_px != defaults.line_width_px)
        json["line-width"] = std::stod(exact_text(appearance.line_width_px));
    // 180 degrees: none.
    constexpr double k_none = 180.0;
    const bool is_own = appearance.crease_angle_deg == defaults.crease_angle_deg &&
                        (appearance.only_clear_creases || defaults.crease_angle_deg == 0.0f);
    if (!is_own && appearance.crease_angle_deg == 0.0f)
        json["crease"] = k_none;
    else if (!is_own && appearance.only_clear_creases)
        json["crease"] = "clear";
    else if (!is_own)
        json["crease"] = double{appearance.crease_angle_deg};
    if (appearance.hidden) json["hidden"] = true;
}

// "picture" of a scene file. What is the style's own is left out.
nlohmann::ordered_json picture_json(const ViewAppearance& appearance, bool is_three_point,
                                    const std::optional<Camera>& frozen, ImageSize size) {
    const StyleDefaults defaults = style_defaults(appearance.style);
    nlohmann::ordered_json json{{"style", style_name(appearance.style)}};
    if (appearance.background != defaults.background)
        json["background"] = hex_of(appearance.background);
    if (appearance.color) json["color"] = hex_of(*appearance.color);
    if (!appearance.materials) json["materials"] = false;
    if (appearance.material_lines)
        json["line-color"] = "material";
    else if (appearance.line_color)
        json["line-color"] = hex_of(*appearance.line_color);
    json["lines"] = appearance.lines;
    if (appearance.lines) add_lines(json, appearance);
    if (!appearance.shadows)
        json["shadows"] = "off";
    else if (appearance.shadow_method == ShadowMethod::fail)
        json["shadows"] = "fail";
    if (is_three_point) json["lighting"] = "three-point";
    if (appearance.ground) json["ground"] = true;
    if (frozen && frozen->is_orthographic())
        json["silhouette-direction"] = short_vector(frozen->eye - frozen->target);
    else if (frozen)
        json["silhouette-from"] = short_vector(frozen->eye);
    std::string sides = std::to_string(size.width);
    sides.append("x").append(std::to_string(size.height));
    json["size"] = std::move(sides);
    return json;
}

// Whether render takes a key that the window does not have together with the others (SceneOptions::check_usage(),
// OutlineOptions::check_usage()).
bool can_stand_beside(const std::string& key, const nlohmann::ordered_json& picture,
                      bool has_style_of_file) {
    const bool is_frozen =
        picture.contains("silhouette-from") || picture.contains("silhouette-direction");
    if (key == "palette") return has_style_of_file;
    const bool has_lines = picture.value("lines", true);
    if (key == "intersections" || key == "min-length") return has_lines && !is_frozen;
    if (key == "outline" || key == "depth-step" || key == "normal-step")
        return !is_frozen && !picture.contains("crease") && !picture.contains("hidden") &&
               picture.value("line-color", "") != "material";
    return true;
}

}  // namespace

namespace {

struct PictureBox {
    glm::dvec2 low{INFINITY}, high{-INFINITY};
};

// Around all positions, in the unit of `window`. Nothing if one lies behind the eye.
std::optional<PictureBox> box_of(const Camera& camera, const Subject& subject,
                                 const glm::dvec2& window) {
    const ScreenView view(camera, window);
    PictureBox box;
    for (const glm::vec3& position : subject.positions) {
        const auto pixel = view.pixel_of(glm::dvec3(position));
        if (!pixel) return std::nullopt;
        box.low = glm::min(box.low, *pixel);
        box.high = glm::max(box.high, *pixel);
    }
    if (subject.positions.empty()) return std::nullopt;
    return box;
}

}  // namespace

void ViewAppearance::set_style(Style chosen) {
    const StyleDefaults defaults = style_defaults(chosen);
    style = chosen;
    background = defaults.background;
    color.reset();
    line_color.reset();
    lines = chosen != Style::mask;  // A mask is black and white, nothing else.
    line_width_px = defaults.line_width_px;
    crease_angle_deg = defaults.crease_angle_deg;
    only_clear_creases = true;
}

LineStyle ViewAppearance::line_style() const {
    LineStyle shown{.crease_degrees = double{crease_angle_deg},
                    .all_creases = !only_clear_creases,
                    .intersections = style_defaults(style).crease_angle_deg > 0.0f,
                    .hidden = hidden};
    if (material_lines && shows_colors(style))
        shown.material_shades_are_light = default_palette(style, background).has_light_ink();
    return shown;
}

bool ViewEdit::operator==(const ViewEdit& other) const {
    return models == other.models && has_chosen_sun == other.has_chosen_sun &&
           (has_chosen_sun || lights == other.lights) && frozen == other.frozen &&
           appearance == other.appearance;
}

void ViewSession::show(Document document, double aspect) {
    PictureOptions defaults;
    defaults.fov_degrees = appearance.fov_y_deg;
    const Subject subject = document.subject();
    if (document.model() != nullptr) {
        const Mesh& mesh = document.model()->mesh();
        const ChosenUp up = settle_up(mesh, defaults.up, false);
        defaults.view.choose(document.name(), mesh, up.up);
    }
    Camera fitted = make_camera(subject, document.name(), defaults);
    fitted = fit_camera(fitted, subject, fitted.eye - fitted.target, aspect);
    std::vector<Light> fitted_lights;
    if (document.model() != nullptr)
        fitted_lights = SceneLights(defaults, document.model()->mesh(), appearance.ground)
                            .lights(fitted, aspect);
    const bool orthographic = appearance.orthographic;
    show(std::move(document), fitted, std::move(fitted_lights));
    if (!is_cloud()) note_chosen_sun();
    appearance.orthographic = orthographic;
    apply_lens();
}

void ViewSession::show(Document document, const Camera& chosen, std::vector<Light> chosen_lights) {
    if (document_) previous_ = std::move(document_);
    document_ = std::move(document);
    camera = chosen;
    lights = std::move(chosen_lights);
    appearance.orthographic = chosen.is_orthographic();
    appearance.fov_y_deg = chosen.fov_y_deg;
    frozen_.reset();
    frame_aspect_.reset();
    kept_ = {};
}

void ViewSession::show(OpenedView opened) {
    appearance = opened.appearance;
    show(std::move(opened.document), opened.camera, std::move(opened.lights));
    if (opened.has_chosen_sun) note_chosen_sun();
    frozen_ = opened.frozen;
    frame_aspect_ = opened.frame_aspect;
    kept_ = {.cameras = std::move(opened.scene_cameras),
             .picture = std::move(opened.unused_picture),
             .style = appearance.style};
}

void ViewSession::replace(Document document) {
    const std::optional<Camera> frozen = frozen_;
    const std::optional<double> frame_aspect = frame_aspect_;
    KeptScene kept = std::move(kept_);
    show(std::move(document), Camera(camera), std::vector<Light>(lights));
    frozen_ = frozen;
    frame_aspect_ = frame_aspect;
    kept_ = std::move(kept);
}

bool ViewSession::show_previous(double aspect) {
    if (!previous_) return false;
    // Drop the document that cannot be drawn, so that show() does not keep it as the previous one.
    document_ = {};
    show(std::exchange(previous_, {}), aspect);
    return true;
}

SceneBounds ViewSession::bounds() const {
    const Subject subject = document_.subject();
    return {.center = subject.center, .radius = subject.radius > 0.0 ? subject.radius : 1.0};
}

void ViewSession::fit(const FreeArea& area) {
    frame_aspect_.reset();
    const bool orthographic = appearance.orthographic;
    appearance.orthographic = false;
    apply_lens();
    camera = fit_camera(camera, document_.subject(), camera.eye - camera.target, area.aspect());
    if (frames_shadow())
        camera =
            frame_with_shadows(camera, document_.model()->mesh(), lights, camera.up, area.aspect());
    appearance.orthographic = orthographic;
    apply_lens();
    if (frames_shadow()) {
        // The middle is that of model and shadow; the model may be aside of it, but wholly in view.
        const double middle = area.left + 0.5 * area.width();
        pan(camera, {(middle - 0.5 * area.window.x) / area.window.y, 0.0});
    }
    bring_into(area, frames_shadow() ? Place::nearest : Place::middle);
}

// Away from the window's middle a perspective picture is another one: near parts move farther. It converges.
void ViewSession::bring_into(const FreeArea& area, Place place) {
    constexpr int k_steps = 5;
    constexpr double k_near_enough = 1e-3;  // In heights of the window.
    const glm::dvec2 size(area.width(), area.window.y);
    const glm::dvec2 middle(area.left + 0.5 * size.x, 0.5 * size.y);
    for (int step = 0; step < k_steps; ++step) {
        const std::optional<PictureBox> box = box_of(camera, document_.subject(), area.window);
        if (!box) {  // A part lies behind the eye.
            zoom(camera, 2.0, 0.0, 1e3 * bounds().radius);
            continue;
        }
        const glm::dvec2 sides = k_picture_margin * (box->high - box->low);
        glm::dvec2 shift = middle - 0.5 * (box->low + box->high);
        if (place == Place::nearest) {
            const glm::dvec2 room = glm::max(0.5 * (size - sides), 0.0);
            shift -= glm::clamp(shift, -room, room);
        }
        const double excess = std::max(sides.x / size.x, sides.y / size.y);
        pan(camera, glm::dvec2(shift.x, -shift.y) / area.window.y);
        if (excess > 1.0) zoom(camera, excess, 0.0, 1e3 * bounds().radius);
        if (excess <= 1.0 + k_near_enough && glm::length(shift) <= k_near_enough * size.y) return;
    }
}

void ViewSession::keep_whole(const FreeArea& area) { bring_into(area, Place::nearest); }

Camera ViewSession::shown_camera(const FreeArea& area) const {
    const bool has_size = area.window.x > 0.0 && area.window.y > 0.0;
    if (!frame_aspect_ || !has_size) return camera;
    const double widening = std::max(*frame_aspect_ / area.aspect(), 1.0);
    const double aside = (2.0 * area.left + area.width()) / area.window.x - 1.0;
    if (widening == 1.0 && aside == 0.0) return camera;
    Camera shown = camera;
    shown.ortho_height *= widening;
    const double tangent = widening * std::tan(0.5 * glm::radians(camera.fov_y_deg));
    shown.fov_y_deg = glm::degrees(2.0 * std::atan(tangent));
    // A near plane clips; an orthographic one lies before the ground too.
    const SceneBounds sphere = bounds();
    const double reach = camera.is_orthographic() ? 100.0 : 1.0;
    shown.projection =
        make_projection(shown, area.window.x / area.window.y, sphere.center, reach * sphere.radius);
    shown.projection->shift.x = aside;
    return shown;
}

glm::dvec3 ViewSession::middle_of(const FreeArea& area) const {
    if (frame_aspect_) return camera.target;
    const double aside = (area.left + 0.5 * area.width() - 0.5 * area.window.x) / area.window.y;
    const glm::dvec3 right = glm::transpose(camera_from_world(camera))[0];
    return camera.target + aside * view_height(camera) * right;
}

// As the camera may look: straight from above, the front is below.
glm::dvec3 ViewSession::level_direction(const glm::dvec3& towards_viewer) const {
    const glm::dvec3 up = glm::normalize(camera.up);
    const glm::dvec3 direction = glm::normalize(towards_viewer);
    const double limit = std::sin(glm::radians(k_max_elevation_deg));
    const double height = std::clamp(glm::dot(direction, up), -limit, limit);
    const glm::dvec3 level = direction - glm::dot(direction, up) * up;
    const glm::dvec3 front = -ground_axes(up).second;
    const glm::dvec3 horizontal = glm::length(level) > 1e-6 ? glm::normalize(level) : front;
    return std::sqrt(1.0 - height * height) * horizontal + height * up;
}

void ViewSession::look_from(const glm::dvec3& towards_viewer) {
    const double distance = glm::distance(camera.eye, camera.target);
    camera.target = bounds().center;
    camera.eye = camera.target + distance * level_direction(towards_viewer);
}

void ViewSession::move_to(const glm::dvec3& towards_viewer) {
    const bool moves_sun = has_chosen_sun();
    const glm::dmat3 to_axes = camera_from_world(camera);
    turn_about(camera, bounds().center, level_direction(towards_viewer));
    if (!moves_sun) return;
    lights[0].vector = glm::transpose(camera_from_world(camera)) * (to_axes * lights[0].vector);
    note_chosen_sun();
}

bool ViewSession::is_whole(const FreeArea& area) const {
    const std::optional<PictureBox> box =
        box_of(shown_camera(area), document_.subject(), area.window);
    return box && box->low.x >= area.left && box->high.x <= area.left + area.width() &&
           box->low.y >= 0.0 && box->high.y <= area.window.y;
}

void ViewSession::choose_sun(double aspect) {
    PictureOptions options;
    options.up = glm::vec3(camera.up);
    lights =
        SceneLights(options, document_.model()->mesh(), appearance.ground).lights(camera, aspect);
    note_chosen_sun();
}

bool ViewSession::has_chosen_sun() const {
    return lights.size() == 1 && lights[0].directional && lights[0].vector == chosen_sun_;
}

ViewEdit ViewSession::edit() const {
    const bool chosen = !is_cloud() && has_chosen_sun();
    const ModelDocument* const shown = document_.model();
    return {.models = shown ? shown->models() : std::vector<PlacedModel>(),
            .scene_up = shown ? shown->scene_up() : std::nullopt,
            .has_chosen_sun = chosen,
            .lights = lights,
            .frozen = frozen_,
            .appearance = appearance};
}

void ViewSession::restore(const ViewEdit& edit) {
    const bool has_lens = appearance.fov_y_deg == edit.appearance.fov_y_deg &&
                          appearance.orthographic == edit.appearance.orthographic;
    appearance = edit.appearance;
    frozen_ = edit.frozen;
    if (!has_lens) apply_lens();
    if (edit.has_chosen_sun && has_chosen_sun()) return;
    lights = edit.lights;
    if (edit.has_chosen_sun) note_chosen_sun();
}

void ViewSession::round_to_options() {
    camera = rounded_to_float(camera);
    round_lights();
}

void ViewSession::round_lights() {
    if (frozen_ && frozen_->is_orthographic())
        frozen_->eye = frozen_->target + rounded_to_float(frozen_->eye - frozen_->target);
    else if (frozen_)
        frozen_->eye = rounded_to_float(frozen_->eye);
    const bool was_chosen = has_chosen_sun();
    for (Light& light : lights) light.vector = rounded_to_float(light.vector);
    if (was_chosen) note_chosen_sun();
}

std::string ViewSession::command_obstacle() const {
    if (is_cloud()) {
        const bool is_usual = !appearance.color && !appearance.line_color && appearance.lines &&
                              appearance.line_width_px == k_cloud_line_width_px;
        return is_usual ? ""
                        : "`points` has no options for the colors of surface and ink, for lines "
                          "and their width: save a picture (P) instead";
    }
    const ModelDocument& model = *document_.model();
    constexpr const char* k_instead = ": save a scene file (X) instead";
    if (model.scene_up() && *model.scene_up() != camera.up)
        return std::string("up is another axis than that of the scene, which no command says") +
               k_instead;
    const auto differs = [&](const PlacedModel& placed) {
        return placed.subdivide != model.models().front().subdivide;
    };
    if (std::ranges::any_of(model.models(), differs))
        return std::string("the models are subdivided in different ways, which no command says") +
               k_instead;
    return {};
}

// With its camera in the coordinates of the file.
std::string ViewSession::cloud_command(ImageSize size, const std::string& output) const {
    const UmbrellaIndex& umbrellas = cloud().umbrellas();
    const CloudArgument& argument = cloud().argument();
    const Camera rounded = rounded_to_float(camera);
    const auto point = [&](const char* option, const glm::dvec3& in_index) {
        const glm::dvec3 p = umbrellas.from_index(in_index);
        const std::string value = exact_text(p.x) + "," + exact_text(p.y) + "," + exact_text(p.z);
        // A value that begins with a minus sign would look like an option.
        return std::string(" ") + option + (value.starts_with('-') ? "=" : " ") + value;
    };
    std::string command = "rimline points ";
    command += quoted_for_shell((argument.model.starts_with('-') ? "./" : "") + argument.model);
    if (argument.as_points) command += " --as-points";
    if (argument.drop_bad) command += " --drop-bad";
    if (argument.subdivide > 0) command += " --subdivide " + std::to_string(argument.subdivide);
    command += point("--eye", rounded.eye) + point("--target", rounded.target);
    command += " " + vector_argument("--up", rounded.up);
    command += rounded.is_orthographic()
                   ? " --ortho " + exact_text(rounded.ortho_height / umbrellas.scale())
                   : " --fov " + exact_text(rounded.fov_y_deg);
    if (frozen_ && frozen_->is_orthographic())
        command +=
            " " + vector_argument("--direction", rounded_to_float(frozen_->eye - frozen_->target));
    else if (frozen_)
        command += point("--from", rounded_to_float(frozen_->eye));
    command += " --background " + quoted_for_shell(hex_of(appearance.background)) + " --size " +
               std::to_string(size.width) + "x" + std::to_string(size.height);
    return command + " -o " + quoted_for_shell(output);
}

std::string ViewSession::command(ImageSize size, const std::string& output) const {
    if (is_cloud()) return cloud_command(size, output);
    const std::vector<PlacedModel>& models = document_.model()->models();
    const Camera rounded = rounded_to_float(camera);
    std::vector<Light> rounded_lights = lights;
    for (Light& light : rounded_lights) light.vector = rounded_to_float(light.vector);
    std::vector<std::string> arguments = camera_arguments(rounded, rounded_lights);
    std::string command = "rimline render ";
    if (models.size() > 1 || models.front().is_placed()) {
        // After several models it would belong to the last one.
        const std::string up = vector_argument("--up", rounded.up);
        std::erase(arguments, up);
        command += up + " ";
    }
    command += words_of(models);
    const nlohmann::ordered_json picture =
        picture_json(appearance, is_three_point(), frozen_, size);
    for (const auto& [key, value] : picture.items()) {
        if (value.is_boolean()) {
            const bool is_flag = key == "hidden" || key == "ground";
            command += " --" + key + (is_flag ? "" : value.get<bool>() ? " on" : " off");
            continue;
        }
        if (value.is_array()) {
            command += " " + vector_argument("--" + key, {value[0], value[1], value[2]});
            continue;
        }
        command += " --" + key + " " +
                   quoted_for_shell(value.is_string() ? value.get<std::string>() : value.dump());
    }
    for (const std::string& argument : arguments) command += " " + argument;
    return command + " -o " + quoted_for_shell(output);
}

void ViewSession::apply_lens() {
    const double height = view_height(camera);
    camera.fov_y_deg = appearance.fov_y_deg;
    camera.ortho_height = appearance.orthographic ? height : 0.0;
    if (appearance.orthographic) return;
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    const double distance = 0.5 * height / std::tan(0.5 * glm::radians(camera.fov_y_deg));
    camera.eye = camera.target + distance * back;
}

void ViewSession::add_light() {
    // Golden angle steps around the up axis: no two suns coincide.
    const Light last = as_sun(lights.back(), bounds());
    Camera sun_camera{.eye = last.vector, .target = glm::dvec3(0.0), .up = camera.up};
    orbit(sun_camera, {std::numbers::pi * (3.0 - std::sqrt(5.0)), 0.0});
    lights.push_back({.vector = sun_camera.eye, .directional = true});
}

void ViewSession::remove_light(std::size_t light) {
    RIMLINE_CHECK(lights.size() > 1 && light < lights.size());
    lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(light));
}

HomogeneousPoint ViewSession::silhouette_point() const {
    return silhouette_point_of(frozen_ ? *frozen_ : camera);
}

ViewPicture ViewSession::picture(std::optional<ImageSize> exact_size, const LongCall& call) const {
    if (is_cloud()) return cloud_scene();
    Scene shown = scene();
    if (exact_size && appearance.lines && !frozen_)
        shown.instances.front().picture_lines =
            document_.model()->lines().draw(camera, *exact_size, appearance.line_style(), call);
    return shown;
}

ViewSight ViewSession::sight() const {
    const void* const document =
        is_cloud() ? static_cast<const void*>(document_.cloud()) : document_.model();
    return {.document = document,
            .camera = camera,
            .lights = lights,
            .frozen = frozen_,
            .appearance = appearance};
}

SplatScene ViewSession::cloud_scene() const {
    CloudDocument& cloud = *document_.cloud();
    const SceneBounds sphere = bounds();
    SplatScene scene{
        .cloud = &cloud.splats(appearance.background, appearance.color, appearance.line_width_px),
        .strokes = cloud.silhouette_strokes(silhouette_point(), appearance.background,
                                            appearance.line_color, appearance.line_width_px),
        .background = appearance.background,
        .camera = camera,
        .center = sphere.center,
        .radius = sphere.radius};
    if (!appearance.lines) scene.strokes.clear();
    return scene;
}

Scene ViewSession::scene() const {
    Scene scene{.camera = camera,
                .silhouette_camera = frozen_,
                .style = appearance.style,
                .palette = default_palette(appearance.style, appearance.background),
                .shadows = appearance.shadows,
                .shadow_method = appearance.shadow_method,
                .lines = appearance.lines,
                .line_width_px = appearance.line_width_px,
                .hidden_line_strength = appearance.hidden
                                            ? style_defaults(appearance.style).hidden_line_strength
                                            : 0.0f,
                .crease_angle_deg = appearance.crease_angle_deg,
                .only_clear_creases = appearance.only_clear_creases};
    scene.lights = lights;
    if (is_three_point()) add_fill_and_rim(scene);
    ModelDocument& model = *document_.model();
    scene.instances.push_back(
        {.octree = &model.octree(),
         .name = model.name(),
         .material = {.color = appearance.color.value_or(
                          default_surface_color(appearance.style, appearance.background)),
                      .shows_mesh_colors = model.has_paint() || appearance.shows_file_colors(),
                      .line_color = appearance.line_color,
                      .lines_in_mesh_colors = appearance.material_lines},
         .is_solid = model.is_solid()});
    const glm::dvec3 ground_up = scene_up();
    if (appearance.ground)
        scene.instances.push_back(ground_instance(scene, model.mesh(), model.ground(ground_up),
                                                  fade_of_ground(model.mesh(), lights, ground_up)));
    return scene;
}

WrittenScene ViewSession::written_scene(ImageSize size) const {
    const ModelDocument& model = *document_.model();
    const Camera rounded = rounded_to_float(camera);
    std::vector<Light> rounded_lights = lights;
    for (Light& light : rounded_lights) light.vector = rounded_to_float(light.vector);
    // The first one is that of the picture.
    nlohmann::ordered_json cameras{{"window", scene_camera_json(rounded)}};
    for (const auto& [name, other] : kept_.cameras.items())
        if (name != "window") cameras[name] = other;
    nlohmann::ordered_json picture = picture_json(appearance, is_three_point(), frozen_, size);
    for (const auto& [key, value] : kept_.picture.items())
        if (can_stand_beside(key, picture, kept_.style == appearance.style)) picture[key] = value;
    return {.up = rounded_to_float(scene_up()),
            .models = model.models(),
            .lights = scene_lights_json(rounded_lights),
            .cameras = std::move(cameras),
            .picture = std::move(picture)};
}

}  // namespace rimline::tools
