#include "tools/options/view_option.h"

#include <CLI/App.hpp>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <string_view>
#include <vector>

#include "silhouette/field/picture_view.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/ground_axes.h"
#include "tools/nearest_name.h"
#include "tools/options/default_view.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

// By NamedView.
constexpr std::array<std::string_view, 8> k_view_names{"auto",  "front", "back",   "left",
                                                       "right", "top",   "bottom", "three-quarter"};

glm::dvec3 direction_of_view(NamedView view, const glm::dvec3& up) {
    const auto [right, away] = ground_axes(up);
    switch (view) {
        case NamedView::automatic: break;
        case NamedView::front: return -away;
        case NamedView::back: return away;
        case NamedView::left: return -right;
        case NamedView::right: return right;
        case NamedView::top: return glm::normalize(up);
        case NamedView::bottom: return -glm::normalize(up);
        case NamedView::three_quarter: break;
    }
    return three_quarter_direction(up);
}

[[noreturn]] void reject_view(const std::string& text, NamedView first) {
    const std::vector<std::string> names(k_view_names.begin() + std::ptrdiff_t(first),
                                         k_view_names.end());
    std::string listed;
    for (const std::string& name : names) listed += ", " + name;
    throw CLI::ValidationError("--eye", "expected three numbers x,y,z or one of" +
                                            listed.substr(1) + ", not '" + text + "'" +
                                            did_you_mean(text, names));
}

}  // namespace

std::vector<std::string> view_names() { return {k_view_names.begin() + 1, k_view_names.end()}; }

void ViewOption::add(CLI::App& app, NamedView first,
                     std::function<void(const std::string&)> set_eye, const char* description) {
    constexpr const char* k_group = "Camera";
    CLI::Option* eye_option =
        app.add_option_function<std::string>(
               "--eye",
               [this, first, set_eye](const std::string& text) {
                   for (std::size_t i = std::size_t(first); i < k_view_names.size(); ++i)
                       if (text == k_view_names[i]) {
                           name = static_cast<NamedView>(i);
                           return;
                       }
                   if (text.find(',') == std::string::npos) reject_view(text, first);
                   set_eye(text);
               },
               description)
            ->type_name(first == NamedView::automatic ? "X,Y,Z|VIEW|auto" : "X,Y,Z|VIEW")
            ->group(k_group);
    add_number(
        app, "--azimuth", azimuth_deg, -360.0, 360.0,
        "View of the whole model from this side, in degrees: 0 front, 90 right (default with "
        "--elevation: 28.8)")
        ->excludes(eye_option)
        ->group(k_group);
    add_number(app, "--elevation", elevation_deg, -90.0, 90.0,
               "View of the whole model from this height above the horizon, in degrees (default "
               "with --azimuth: 21.5)")
        ->excludes(eye_option)
        ->group(k_group);
}

void ViewOption::add_to(CLI::App& app, std::optional<glm::vec3>& eye) {
    add(
        app, NamedView::automatic,
        [&eye](const std::string& text) { eye = parse_point("--eye", text); },
        "Position of the camera; or a view of the whole model: front, back, left, right, top, "
        "bottom, three-quarter, or auto, the side that shows most (default: auto; the built-in "
        "scene has a view of its own)");
}

void ViewOption::add_to_cloud(CLI::App& app, std::optional<glm::dvec3>& eye) {
    add(
        app, NamedView::front,
        [&eye](const std::string& text) { eye = parse_exact_point("--eye", text); },
        "Position of the camera; or with -o a view of the whole cloud: front, back, left, right, "
        "top, bottom, or three-quarter (default with -o)");
}

std::optional<glm::dvec3> ViewOption::given(const glm::dvec3& up) const {
    if (name && *name != NamedView::automatic) return direction_of_view(*name, up);
    if (!azimuth_deg && !elevation_deg) return std::nullopt;
    const auto [right, away] = ground_axes(up);
    const glm::dvec3 upward = glm::normalize(up);
    const glm::dvec3 usual = three_quarter_direction(up);
    const double azimuth = azimuth_deg ? glm::radians(*azimuth_deg)
                                       : std::atan2(glm::dot(usual, right), -glm::dot(usual, away));
    const double elevation =
        elevation_deg ? glm::radians(*elevation_deg) : std::asin(glm::dot(usual, upward));
    return std::cos(elevation) * (std::sin(azimuth) * right - std::cos(azimuth) * away) +
           std::sin(elevation) * upward;
}

void ViewOption::choose(const std::string& model, const Mesh& mesh, const glm::dvec3& up,
                        const LongCall& call) {
    const bool is_own = model == k_default_model && !name;
    if (!is_own && !given(up)) chosen = choose_picture_direction(mesh, up, call);
}

glm::dvec3 ViewOption::direction(const std::string& model, const glm::dvec3& up) const {
    if (chosen) return *chosen;
    return given(up).value_or(default_view_of(model, up));
}

double orbit_angle_rad(const glm::dvec3& direction, const glm::dvec3& up) {
    const Orbit orbit(glm::dvec3(0.0), up, 1.0);
    const glm::dvec2 level(glm::dot(direction, orbit.position(0.0)),
                           glm::dot(direction, orbit.position(0.5 * std::numbers::pi)));
    // Rounding must not turn a view along an axis away from it.
    constexpr double k_rounding = 1e-12;
    if (glm::length(level) < 1e-3 * glm::length(direction)) return 0.0;
    return std::abs(level.y) < k_rounding && level.x > 0.0 ? 0.0 : std::atan2(level.y, level.x);
}

glm::dvec3 up_in_picture(const glm::dvec3& direction, const glm::dvec3& up) {
    const glm::dvec3 upward = glm::normalize(up);
    const double height = glm::dot(glm::normalize(direction), upward);
    if (std::abs(height) < 0.999) return up;
    const glm::dvec3 away = ground_axes(up).second;
    return height > 0.0 ? away : -away;
}

}  // namespace rimline::tools
