#include "tools/options/line_camera.h"

#include <CLI/App.hpp>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "silhouette/error.h"
#include "silhouette/lines/fitted_eye.h"
#include "tools/command.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

// As PictureOptions has them.
constexpr double k_default_fov_degrees = 35.0;
constexpr double k_default_aspect = 4.0 / 3.0;
// A model that is seen at a greater angle from the view's direction is cut by the frame. Tangent of 80 degrees.
constexpr double k_max_tangent = 5.67;

void parse_ortho(const std::string& text, LineCameraOptions& options) {
    options.is_orthographic = true;
    options.ortho_height.reset();
    if (text == "auto") return;
    double height = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), height);
    // Also false for NaN.
    const bool is_in_range = height >= k_min_ortho_height && height <= k_max_ortho_height;
    if (error != std::errc() || end != text.data() + text.size() || !is_in_range)
        throw CLI::ValidationError(
            "--ortho", "expected auto or a height from 1e-12 to 1e18, not '" + text + "'");
    options.ortho_height = height;
}

}  // namespace

void LineCameraOptions::add_to(CLI::App& app) {
    constexpr const char* k_group = "Camera";
    view.add_to(app, eye);
    add_point(app, "--target", target,
              "Point that the camera looks at (default: the model's center)")
        ->group(k_group);
    add_up_or_auto(app, up, is_up_auto)->group(k_group);
    CLI::Option* fov =
        add_number(app, "--fov", fov_degrees, 0.01, 170.0,
                   "Vertical field of view in degrees (default: 35). With --eye X,Y,Z, the "
                   "drawing ends at its borders; if not given, it shows the whole "
                   "model")
            ->group(k_group);
    app.add_option_function<std::string>(
           "--ortho", [this](const std::string& text) { parse_ortho(text, *this); },
           "Orthographic view of this height in the model's units; auto: of the whole model")
        ->type_name("HEIGHT|auto")
        ->excludes(fov)
        ->group(k_group);
}

glm::dvec3 LineCameraOptions::up_of(const Mesh& mesh) const {
    return choose_up(mesh, up, is_up_auto).up;
}

void LineCameraOptions::choose_view(const std::string& model, const Mesh& mesh,
                                    const LongCall& call) {
    if (!eye) view.choose(model, mesh, up_of(mesh), call);
}

LineCamera LineCameraOptions::make_camera(const std::string& model, const Mesh& mesh) const {
    glm::dvec3 upwards = up_of(mesh);
    const double tangent =
        std::tan(0.5 * glm::radians(fov_degrees.value_or(k_default_fov_degrees)));
    FittedEye place{};
    if (eye) {
        place = {glm::dvec3(*eye), target ? glm::dvec3(*target) : mesh.center()};
        if (place.eye == place.target)
            throw UsageError(target ? "--eye and --target are the same point"
                                    : "--eye is the model's center, where it looks");
    } else {
        const glm::dvec3 direction = view.direction(model, upwards);
        upwards = up_in_picture(direction, upwards);
        place = is_orthographic
                    ? FittedEye{mesh.center() + 3.0 * mesh.radius() * glm::normalize(direction),
                                mesh.center()}
                    : fit_eye(mesh.positions(), mesh.center(), mesh.radius(), direction, upwards,
                              {tangent * k_default_aspect, tangent});
        if (target) {
            place.eye += glm::dvec3(*target) - place.target;
            place.target = glm::dvec3(*target);
        }
    }
    if (!HomogeneousPoint::is_valid(glm::vec3(place.eye)))
        throw Error(ErrorCode::too_large,
                    model +
                        ": too large for this camera: scale it down, or take a "
                        "greater --fov; coordinates end at 2^60");
    return {
        .name = "camera",
        .view = is_orthographic ? LineView::orthographic(place.eye, place.target, upwards)
                                : LineView::perspective(place.eye, place.target, upwards,
                                                        drawn_distance(mesh, place.eye)),
        .eye = place.eye,
        .target = place.target,
        .up = upwards,
        .half_height = is_orthographic ? 0.5 * ortho_height.value_or(2.0 * mesh.radius()) : tangent,
        .is_framed = ortho_height || (eye && fov_degrees)};
}

ShownPart shown_part(const LineCamera& camera, const Mesh& mesh, double aspect) {
    const glm::dvec2 reach(camera.half_height * aspect, camera.half_height);
    const ShownPart frame{-reach, reach, true};
    if (camera.is_framed) return frame;
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(-std::numeric_limits<double>::max());
    double nearest = std::numeric_limits<double>::max();
    for (const glm::vec3& position : mesh.positions()) {
        const LineView::Projected seen = camera.view.project(glm::dvec3(position));
        low = glm::min(low, seen.position);
        high = glm::max(high, seen.position);
        nearest = std::min(nearest, seen.depth);
    }
    if (!camera.view.is_orthographic()) {
        const glm::dvec2 farthest = glm::max(glm::abs(low), glm::abs(high));
        // Also where a position lies at the depth of the eye and its picture is not finite.
        const bool is_before =
            nearest > 0.0 && farthest.x < k_max_tangent && farthest.y < k_max_tangent;
        if (!is_before) return frame;
    }
    return {low, high, false};
}

}  // namespace rimline::tools
