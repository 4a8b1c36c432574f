#include "tools/options/picture_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>

#include "silhouette/lines/fitted_eye.h"
#include "tools/command.h"
#include "tools/options/view_camera.h"

namespace rimline::tools {

glm::vec3 linear_from_srgb(const Color& color) {
    return linear_from_srgb(glm::vec3(float(color.red) / 255.0f, float(color.green) / 255.0f,
                                      float(color.blue) / 255.0f));
}

Color nearest_srgb(const glm::vec3& linear) {
    const glm::vec3 srgb = 255.0f * glm::clamp(srgb_from_linear(linear), 0.0f, 1.0f);
    const auto byte = [](float c) { return static_cast<std::uint8_t>(std::lround(c)); };
    return {byte(srgb.x), byte(srgb.y), byte(srgb.z)};
}

glm::dvec3 up_of(const Subject& subject, const PictureOptions& options) {
    if (options.up) return glm::dvec3(*options.up);
    return direction_of(subject.up);
}

glm::dvec3 ground_up_of(const Subject& subject, const PictureOptions& options) {
    return options.ground_up ? glm::dvec3(*options.ground_up) : up_of(subject, options);
}

Camera rounded_to_float(const Camera& camera) {
    Camera rounded = camera;
    rounded.eye = rounded_to_float(camera.eye);
    rounded.target = rounded_to_float(camera.target);
    rounded.up = rounded_to_float(camera.up);
    return rounded.eye == rounded.target ? camera : rounded;
}

namespace {

// A camera with an eye that shows the whole subject, where there is one.
Camera with_whole(Camera camera, const Subject& subject, double aspect) {
    const std::optional<FittedLens> lens =
        fit_lens(subject.positions, subject.center, camera.eye, camera.up, aspect);
    if (!lens) return rounded_to_float(camera);
    camera.target = lens->target;
    camera.up = lens->up;
    camera.fov_y_deg = field_of_view_deg(*lens);
    return rounded_to_float(camera);
}

}  // namespace

Camera make_camera(const Subject& subject, const std::string& model,
                   const PictureOptions& options) {
    const glm::dvec3 up = rounded_to_float(up_of(subject, options));
    const double aspect = double(options.size.width) / options.size.height;
    Camera camera{.eye = {},
                  .target = {},
                  .up = up,
                  .fov_y_deg = options.fov(),
                  .ortho_height = options.ortho_height.value_or(0.0)};
    if (options.eye) {
        camera.eye = glm::dvec3(*options.eye);
        camera.target = options.target ? glm::dvec3(*options.target) : subject.center;
        if (camera.eye == camera.target)
            throw UsageError(options.target ? "--eye and --target are the same point"
                                            : "--eye is the model's center, where it looks");
        const bool is_framed = !options.target && !options.fov_degrees && !camera.is_orthographic();
        return is_framed ? with_whole(camera, subject, aspect) : rounded_to_float(camera);
    }
    const glm::dvec3 direction = options.view.direction(model, up);
    camera.up = rounded_to_float(up_in_picture(direction, up));
    camera = fit_camera(camera, subject, direction, aspect);
    if (options.target) {
        camera.eye += glm::dvec3(*options.target) - camera.target;
        camera.target = glm::dvec3(*options.target);
    }
    return rounded_to_float(camera);
}

std::optional<Camera> silhouette_camera_of(const Subject& subject, const Camera& camera,
                                           const std::optional<glm::dvec3>& from,
                                           const PictureOptions& options) {
    Camera seen{.eye = {}, .target = subject.center, .up = camera.up, .fov_y_deg = options.fov()};
    if (from) {
        seen.eye = *from;
        if (seen.eye == seen.target) throw UsageError("--silhouette-from is the model's center");
        return seen;
    }
    if (!options.silhouette_direction) return std::nullopt;
    // As far away as a camera that shows the whole subject.
    const double radius = subject.radius > 0.0 ? subject.radius : 1.0;
    const glm::dvec3 direction = glm::normalize(glm::dvec3(*options.silhouette_direction));
    seen.eye = seen.target + 4.0 * radius * direction;
    seen.ortho_height = 2.0 * radius;
    return seen;
}

bool is_out_of_view(const Mesh& mesh, const Camera& camera, double aspect) {
    const glm::dmat3 axes = camera_from_world(camera);
    const Projection projection =
        make_projection(camera, aspect, mesh.center(), std::max(mesh.radius(), 1e-30));
    std::array<std::size_t, 5> outside{};
    for (const glm::vec3& position : mesh.positions()) {
        const glm::dvec3 p = axes * (glm::dvec3(position) - camera.eye);
        const double w = projection.w[0] * p.z + projection.w[1];
        const glm::dvec2 clip = projection.scale * glm::dvec2(p) + projection.shift * w;
        const std::array<bool, 5> is_outside{(clip.x < -w), (clip.x > w), (clip.y < -w),
                                             (clip.y > w), (w < 0.0)};
        for (std::size_t i = 0; i < 5; ++i) outside[i] += is_outside[i];
    }
    const std::size_t count = mesh.positions().size();
    return std::ranges::find(outside, count) != outside.end();
}

SceneInstance ground_instance(const Scene& scene, const Mesh& mesh, const HoughOctree& octree,
                              double fade_radius) {
    // Strokes of Style::hatch in the shadow are those of the model.
    const std::optional<glm::vec3> line_color =
        scene.instances.empty() ? std::nullopt : scene.instances.front().material.line_color;
    return {.octree = &octree,
            .material = {.color = scene.style == Style::mask ? glm::vec3(1.0f)
                                                             : scene.palette.background,
                         .line_color = line_color},
            // On no background only the shadows are left of it.
            .has_surfaces = scene.has_background,
            .has_lines = false,
            .casts_shadows = false,
            .fade_radius = fade_radius,
            .fade_center = mesh.center()};
}

}  // namespace rimline::tools
