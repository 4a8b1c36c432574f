#include "tools/view/view_input.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/view/camera_motion.h"
#include "tools/view/light_handles.h"
#include "tools/view/view_marks.h"

namespace rimline::tools {

namespace {

constexpr double k_turn_rad_per_unit = 0.0065;
constexpr double k_zoom_per_notch = 0.88;
constexpr double k_push_per_notch = 1.06;
// In the model's radii per second.
constexpr double k_fly_speed = 1.2;
// Shift multiplies the speed by this.
constexpr double k_fast_factor = 4.0;
// The mouse selects a handle within this distance, in units of the panel.
constexpr double k_handle_reach = 14.0;
// Limits of the camera's distance from its target, in the model's radii.
constexpr double k_min_distance = 0.02;
constexpr double k_max_distance = 60.0;
// Longest time of one step of a flight, even if the frame took longer.
constexpr double k_max_step_s = 0.1;

}  // namespace

void ViewInput::move_lights(ViewSession& session, const FreeArea& area) {
    const ImGuiIO& io = ImGui::GetIO();
    const SceneBounds bounds = session.bounds();
    const ScreenView view(session.shown_camera(area), area.window);
    const auto [low, high] = area.corners(k_handle_margin);
    const glm::dvec2 mouse(io.MousePos.x, io.MousePos.y);
    if (!io.MouseDown[0] || (dragged_light_ && *dragged_light_ >= session.lights.size()))
        dragged_light_.reset();
    if (dragged_light_) {
        if (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)
            drag_light(session.lights[*dragged_light_], bounds, view, mouse);
        return;
    }
    hovered_light_.reset();
    if (io.WantCaptureMouse || drags_picture_) return;
    double nearest = k_handle_reach;
    for (std::size_t i = 0; i < session.lights.size(); ++i) {
        const glm::dvec2 pixel = shown_handle(session.lights[i], bounds, view, low, high).pixel;
        if (glm::distance(pixel, mouse) > nearest) continue;
        nearest = glm::distance(pixel, mouse);
        hovered_light_ = i;
    }
    if (!hovered_light_) return;
    if (io.MouseWheel != 0.0f)
        push_light(session.lights[*hovered_light_], bounds, view,
                   std::pow(k_push_per_notch, double(io.MouseWheel)));
    if (ImGui::IsMouseClicked(0)) dragged_light_ = hovered_light_;
}

void ViewInput::move_camera(ViewSession& session, const FreeArea& area, const glm::dvec2& moved) {
    const ImGuiIO& io = ImGui::GetIO();
    if (is_framed) has_own_target_ = false;
    if (drags_picture_ && (moved.x != 0.0 || moved.y != 0.0)) {
        const bool pans = io.MouseDown[1] || io.MouseDown[2] || io.KeyShift;
        if (flies || pans) {
            is_framed = false;
            has_own_target_ = true;
        }
        const double height = view_height(session.shown_camera(area)) / view_height(session.camera);
        const glm::dvec2 turn_rad = k_turn_rad_per_unit * glm::dvec2(-moved.x, moved.y);
        if (flies)
            turn_view(session.camera, -turn_rad);
        else if (pans)
            pan(session.camera, height / area.window.y * glm::dvec2(moved.x, -moved.y));
        else
            orbit_about(session.camera,
                        has_own_target_ ? session.middle_of(area) : session.bounds().center,
                        turn_rad);
        // It may be wider from this side.
        if (is_framed) session.keep_whole(area);
    }
    if (io.MouseWheel != 0.0f && !io.WantCaptureMouse && !hovered_light_) {
        is_framed = false;
        const double radius = session.bounds().radius;
        // A camera that is beyond its limits already only comes back.
        const Camera& camera = session.camera;
        const double now = camera.is_orthographic() ? camera.ortho_height
                                                    : glm::distance(camera.eye, camera.target);
        zoom(session.camera, std::pow(k_zoom_per_notch, double(io.MouseWheel)),
             std::min(k_min_distance * radius, now), std::max(k_max_distance * radius, now));
    }
}

bool ViewInput::move_flight(ViewSession& session) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!flies || io.WantTextInput) return false;
    const auto along = [&](int forwards, int backwards) {
        return (io.KeysDown[forwards] ? 1.0 : 0.0) - (io.KeysDown[backwards] ? 1.0 : 0.0);
    };
    const glm::dvec3 direction(along(GLFW_KEY_D, GLFW_KEY_A), along(GLFW_KEY_E, GLFW_KEY_Q),
                               along(GLFW_KEY_W, GLFW_KEY_S));
    if (direction == glm::dvec3(0.0)) return false;
    is_framed = false;
    has_own_target_ = true;
    const double seconds = std::min(double(io.DeltaTime), k_max_step_s);
    const double speed =
        k_fly_speed * session.bounds().radius * (io.KeyShift ? k_fast_factor : 1.0);
    const glm::dvec3 step = seconds * speed * glm::normalize(direction);
    // Limit the distance: coordinates have a limited range.
    const Camera before = session.camera;
    fly(session.camera, step);
    const glm::dvec3 center = session.bounds().center;
    const double reach = glm::distance(session.camera.eye, center);
    if (reach > 2.0 * k_max_distance * session.bounds().radius &&
        reach > glm::distance(before.eye, center))
        session.camera = before;
    return true;
}

bool ViewInput::apply(ViewSession& session, const FreeArea& area, bool has_handles,
                      const std::optional<Window::MousePress>& press) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 mouse(io.MousePos.x, io.MousePos.y);
    const glm::dvec2 moved = press ? press->to.value_or(mouse) - press->from
                                   : glm::dvec2(io.MouseDelta.x, io.MouseDelta.y);
    const bool any_down = io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2];
    const bool clicked =
        ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
    if (has_handles) {
        move_lights(session, area);
    } else {
        hovered_light_.reset();
        dragged_light_.reset();
    }
    if (!any_down) drags_picture_ = false;
    if (clicked && !io.WantCaptureMouse && !dragged_light_) drags_picture_ = true;
    move_camera(session, area, moved);
    const bool flying = move_flight(session);
    return flying || drags_picture_ || dragged_light_.has_value();
}

}  // namespace rimline::tools
