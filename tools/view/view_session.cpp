#include "tools/view/view_session.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

#include "engine/view_defaults.h"
#include "tools/options/picture_scene.h"
#include "tools/view/camera_motion.h"
#include "tools/view/light_handles.h"

namespace rimline::tools {

void ViewLook::set_style(Style chosen) {
    const StyleDefaults defaults = style_defaults(chosen);
    style = chosen;
    background = defaults.background;
    color.reset();
    line_color.reset();
    line_width_px = defaults.line_width_px;
    crease_angle_deg = defaults.crease_angle_deg;
}

void ViewSession::show(Document opened, double aspect) {
    PictureOptions defaults;
    defaults.fov_degrees = look.fov_y_deg;
    const Subject subject = opened.subject();
    Camera fitted = make_camera(subject, opened.name(), defaults);
    fitted = fit_camera(fitted, subject, fitted.eye - fitted.target, aspect);
    std::vector<Light> fitted_lights;
    if (opened.model() != nullptr) fitted_lights.push_back(default_sun(fitted));
    const bool orthographic = look.orthographic;
    show(std::move(opened), fitted, std::move(fitted_lights));
    look.orthographic = orthographic;
    apply_lens();
}

void ViewSession::show(Document opened, const Camera& chosen, std::vector<Light> chosen_lights) {
    if (opened_) previous_ = std::move(opened_);
    opened_ = std::move(opened);
    camera = chosen;
    lights = std::move(chosen_lights);
    look.orthographic = chosen.is_orthographic();
    look.fov_y_deg = chosen.fov_y_deg;
    frozen_.reset();
}

bool ViewSession::show_previous(double aspect) {
    if (!previous_) return false;
    // What cannot be drawn is gone before it could be asked for again.
    opened_ = {};
    show(std::exchange(previous_, {}), aspect);
    return true;
}

SceneBounds ViewSession::bounds() const {
    const Subject subject = opened_.subject();
    return {.center = subject.center, .radius = subject.radius > 0.0 ? subject.radius : 1.0};
}

void ViewSession::fit(double aspect) {
    const bool orthographic = look.orthographic;
    look.orthographic = false;
    apply_lens();
    camera = fit_camera(camera, opened_.subject(), camera.eye - camera.target, aspect);
    look.orthographic = orthographic;
    apply_lens();
}

void ViewSession::apply_lens() {
    const double height = view_height(camera);
    camera.fov_y_deg = look.fov_y_deg;
    camera.ortho_height = look.orthographic ? height : 0.0;
    if (look.orthographic) return;
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    const double distance = 0.5 * height / std::tan(0.5 * glm::radians(camera.fov_y_deg));
    camera.eye = camera.target + distance * back;
}

void ViewSession::add_light() {
    if (lights.empty()) {
        lights.push_back(default_sun(camera));
        return;
    }
    // Each a golden angle further around the up axis, so that no two coincide.
    const Light last = as_sun(lights.back(), bounds());
    Camera around{.eye = last.vector, .target = glm::dvec3(0.0), .up = camera.up};
    orbit(around, {std::numbers::pi * (3.0 - std::sqrt(5.0)), 0.0});
    lights.push_back({.vector = around.eye, .directional = true});
}

void ViewSession::remove_light(std::size_t light) {
    lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(light));
}

HomogeneousPoint ViewSession::silhouette_point() const {
    return silhouette_point_of(frozen_ ? *frozen_ : camera);
}

ViewPicture ViewSession::picture() const {
    if (is_cloud()) return cloud_scene();
    return scene();
}

SplatScene ViewSession::cloud_scene() const {
    CloudDocument& cloud = *opened_.cloud();
    const SceneBounds around = bounds();
    SplatScene scene{
        .cloud = &cloud.drawn(look.color, look.line_width_px),
        .strokes = cloud.follow(silhouette_point(), look.line_color, look.line_width_px),
        .background = look.background,
        .camera = camera,
        .center = around.center,
        .radius = around.radius};
    if (!look.lines) scene.strokes.clear();
    return scene;
}

Scene ViewSession::scene() const {
    Scene scene{.camera = camera,
                .silhouette_camera = frozen_,
                .style = look.style,
                .palette = default_palette(look.style, look.background),
                .shadows = look.shadows,
                .shadow_method = look.shadow_method,
                .lines = look.lines,
                .line_width_px = look.line_width_px,
                .hidden_line_strength =
                    look.hidden ? style_defaults(look.style).hidden_line_strength : 0.0f,
                .crease_angle_deg = look.crease_angle_deg};
    scene.lights = lights;
    ModelDocument& model = *opened_.model();
    scene.instances.push_back({.octree = &model.octree(),
                               .name = model.name(),
                               .material = {.color = look.color.value_or(
                                                default_surface_color(look.style, look.background)),
                                            .line_color = look.line_color},
                               .is_solid = model.is_solid()});
    if (look.ground)
        scene.instances.push_back(ground_instance(scene, model.mesh(), model.ground(camera.up)));
    return scene;
}

}  // namespace rimline::tools
