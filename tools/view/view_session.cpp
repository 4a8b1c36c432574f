#include "tools/view/view_session.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

#include "engine/view_defaults.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/up_option.h"
#include "tools/view/camera_motion.h"
#include "tools/view/light_handles.h"

namespace rimline::tools {

void ViewAppearance::set_style(Style chosen) {
    const StyleDefaults defaults = style_defaults(chosen);
    style = chosen;
    background = defaults.background;
    color.reset();
    line_color.reset();
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

void ViewSession::fit(double aspect) {
    const bool orthographic = appearance.orthographic;
    appearance.orthographic = false;
    apply_lens();
    camera = fit_camera(camera, document_.subject(), camera.eye - camera.target, aspect);
    if (document_.model() != nullptr && appearance.ground && appearance.shadows)
        camera = frame_with_shadows(camera, document_.model()->mesh(), lights, camera.up, aspect);
    appearance.orthographic = orthographic;
    apply_lens();
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
    if (lights.empty()) {
        lights.push_back(default_sun(camera));
        return;
    }
    // Golden angle steps around the up axis: no two suns coincide.
    const Light last = as_sun(lights.back(), bounds());
    Camera sun_camera{.eye = last.vector, .target = glm::dvec3(0.0), .up = camera.up};
    orbit(sun_camera, {std::numbers::pi * (3.0 - std::sqrt(5.0)), 0.0});
    lights.push_back({.vector = sun_camera.eye, .directional = true});
}

void ViewSession::remove_light(std::size_t light) {
    lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(light));
}

HomogeneousPoint ViewSession::silhouette_point() const {
    return silhouette_point_of(frozen_ ? *frozen_ : camera);
}

ViewPicture ViewSession::picture(std::optional<ImageSize> exact_size) const {
    if (is_cloud()) return cloud_scene();
    Scene shown = scene();
    if (exact_size && appearance.lines && !frozen_)
        shown.instances.front().picture_lines =
            document_.model()->lines().draw(camera, *exact_size, appearance.line_style());
    return shown;
}

SplatScene ViewSession::cloud_scene() const {
    CloudDocument& cloud = *document_.cloud();
    const SceneBounds sphere = bounds();
    SplatScene scene{.cloud = &cloud.splats(appearance.color, appearance.line_width_px),
                     .strokes = cloud.silhouette_strokes(silhouette_point(), appearance.line_color,
                                                         appearance.line_width_px),
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
    ModelDocument& model = *document_.model();
    scene.instances.push_back(
        {.octree = &model.octree(),
         .name = model.name(),
         .material = {.color = appearance.color.value_or(
                          default_surface_color(appearance.style, appearance.background)),
                      .shows_mesh_colors = appearance.materials && !appearance.color,
                      .line_color = appearance.line_color,
                      .lines_in_mesh_colors = appearance.material_lines},
         .is_solid = model.is_solid()});
    if (appearance.ground)
        scene.instances.push_back(ground_instance(scene, model.mesh(), model.ground(camera.up),
                                                  fade_of_ground(model.mesh(), lights, camera.up)));
    return scene;
}

}  // namespace rimline::tools
