#include "engine/view_defaults.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>

#include "silhouette/error.h"
#include "silhouette/lines/fitted_eye.h"
#include "silhouette/mesh/ground_axes.h"

namespace rimline {

Camera zoom_camera(Camera camera, const Mesh& mesh, double aspect) {
    constexpr double k_min_fov_deg = 1.0;
    RIMLINE_CHECK(aspect > 0.0);
    camera.ortho_height = 0.0;
    camera.target = mesh.center();
    const std::optional<FittedLens> lens =
        fit_lens(mesh.positions(), mesh.center(), camera.eye, camera.up, aspect);
    if (!lens) return camera;
    camera.target = lens->target;
    camera.up = lens->up;
    camera.fov_y_deg = std::max(2.0 * glm::degrees(std::atan(lens->tangent)), k_min_fov_deg);
    return camera;
}

glm::dvec3 default_view_direction(const glm::dvec3& up) {
    RIMLINE_CHECK(glm::length(up) > 0.0);
    return three_quarter_direction(up);
}

Camera fit_camera(Camera camera, const Subject& subject, const glm::dvec3& towards_viewer,
                  double aspect) {
    RIMLINE_CHECK(aspect > 0.0 && glm::length(towards_viewer) > 0.0);
    if (camera.is_orthographic()) {
        const double radius = subject.radius > 0.0 ? subject.radius : 1.0;
        camera.target = subject.center;
        camera.eye = camera.target + glm::normalize(towards_viewer) * (3.0 * radius);
        return camera;
    }
    RIMLINE_CHECK(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0);
    const double tangent = std::tan(0.5 * glm::radians(camera.fov_y_deg));
    const FittedEye fitted = fit_eye(subject.positions, subject.center, subject.radius,
                                     towards_viewer, camera.up, {tangent * aspect, tangent});
    camera.eye = fitted.eye;
    camera.target = fitted.target;
    return camera;
}

Light default_sun(const Camera& camera) {
    const glm::dmat3 axes = camera_from_world(camera);
    const glm::dvec3 right(axes[0][0], axes[1][0], axes[2][0]);
    const glm::dvec3 back(axes[0][2], axes[1][2], axes[2][2]);
    const glm::dvec3 up = glm::normalize(camera.up);
    return {.vector = glm::normalize(-0.75 * right + 1.1 * up + 0.55 * back), .directional = true};
}

MeshSource make_ground(const Mesh& mesh, const glm::dvec3& up, double radius) {
    RIMLINE_CHECK(glm::length(up) > 0.0 && radius >= 0.0);
    const glm::dvec3 n = glm::normalize(up);
    double lowest = std::numeric_limits<double>::max();
    for (const glm::vec3& position : mesh.positions())
        lowest = std::min(lowest, glm::dot(glm::dvec3(position) - mesh.center(), n));
    if (mesh.positions().empty()) lowest = 0.0;
    // Lower by more than rounding to float changes, so that a flat base does not lie in the ground's plane.
    const glm::dvec3 reach = glm::abs(mesh.center()) + radius;
    const double rounding = 0x1p-22 * std::max({reach.x, reach.y, reach.z});
    const double margin = std::max(5e-4 * mesh.radius(), rounding);
    const glm::dvec3 center = mesh.center() + n * (lowest - margin);
    const auto [first, second] = ground_axes(up);
    MeshSource ground;
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        ground.positions.emplace_back(center + radius * (corner.x * first + corner.y * second));
    ground.triangles = {{0, 1, 2}, {0, 2, 3}};
    return ground;
}

StyleDefaults style_defaults(Style style) {
    // sRGB 248, 244, 236 and 22, 60, 118.
    constexpr glm::vec3 k_paper(0.9387f, 0.9047f, 0.8388f);
    constexpr glm::vec3 k_blue(0.0080f, 0.0452f, 0.1812f);
    switch (style) {
        case Style::ink: return {k_paper, 2.5f, 30.0f, 0.5f};
        case Style::toon: return {k_paper, 2.5f, 0.0f, 0.5f};
        case Style::mask: return {glm::vec3(0.0f), 2.5f, 0.0f, 0.5f};
        case Style::blueprint: return {k_blue, 1.6f, 30.0f, 0.6f};
        case Style::hatch: return {k_paper, 2.0f, 0.0f, 0.6f};
    }
    return {};
}

Palette default_palette(Style style, const glm::vec3& background) {
    switch (style) {
        case Style::ink: return {background, {0.012f, 0.012f, 0.016f}, {0.50f, 0.51f, 0.55f}};
        case Style::toon: return {background, {0.012f, 0.010f, 0.014f}, {0.30f, 0.33f, 0.46f}};
        case Style::mask: return {background, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
        case Style::blueprint:
            return {background,
                    {0.82f, 0.90f, 1.0f},
                    {0.70f, 0.74f, 0.80f},
                    {0.45f, 0.65f, 1.0f},
                    0.1f};
        case Style::hatch: return {background, {0.016f, 0.014f, 0.018f}, glm::vec3(0.42f)};
    }
    return {};
}

glm::vec3 default_surface_color(Style style, const glm::vec3& background) {
    switch (style) {
        case Style::ink: return background;
        case Style::toon: return {0.78f, 0.36f, 0.18f};
        case Style::mask: return {1.0f, 1.0f, 1.0f};
        case Style::blueprint: return background + glm::vec3(0.010f, 0.026f, 0.050f);
        case Style::hatch: return background;
    }
    return background;
}

}  // namespace rimline
