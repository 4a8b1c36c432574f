#include "tools/view/view_input.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tools/view/camera_motion.h"
#include "tools/view/light_handles.h"

namespace rimline::tools {

namespace {

constexpr double k_turn_rad_per_unit = 0.0065;
constexpr double k_zoom_per_notch = 0.88;
constexpr double k_push_per_notch = 1.06;
// Of the model's radius, in a second.
constexpr double k_fly_speed = 1.2;
constexpr double k_fast_times = 4.0;
// How near to a handle the mouse takes it, in units of the panel.
constexpr double k_reach = 14.0;
// Of the model's radius: how near the camera comes and how far it goes.
constexpr double k_nearest = 0.02;
constexpr double k_farthest = 60.0;
// No single step of a flight takes longer than this, however long the frame did.
constexpr double k_longest_step_s = 0.1;

}  // namespace

void ViewInput::take_light(ViewSession& session, const glm::dvec2& size) {
    const ImGuiIO& io = ImGui::GetIO();
    const SceneBounds bounds = session.bounds();
    const ScreenView view(session.camera, size);
    const glm::dvec2 mouse(io.MousePos.x, io.MousePos.y);
    if (!io.MouseDown[0] || (held_ && *held_ >= session.lights.size())) held_.reset();
    if (held_) {
        if (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)
            drag_light(session.lights[*held_], bounds, view, mouse);
        return;
    }
    hovered_.reset();
    if (io.WantCaptureMouse || holds_picture_) return;
    double nearest = k_reach;
    for (std::size_t i = 0; i < session.lights.size(); ++i) {
        const auto pixel = view.pixel_of(light_handle(session.lights[i], bounds));
        if (!pixel || glm::distance(*pixel, mouse) > nearest) continue;
        nearest = glm::distance(*pixel, mouse);
        hovered_ = i;
    }
    if (!hovered_) return;
    if (io.MouseWheel != 0.0f)
        push_light(session.lights[*hovered_], bounds, view,
                   std::pow(k_push_per_notch, double(io.MouseWheel)));
    if (ImGui::IsMouseClicked(0)) held_ = hovered_;
}

void ViewInput::move_camera(ViewSession& session, const glm::dvec2& size) const {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 moved(io.MouseDelta.x, io.MouseDelta.y);
    if (holds_picture_ && (moved.x != 0.0 || moved.y != 0.0)) {
        const bool pans = io.MouseDown[1] || io.MouseDown[2] || io.KeyShift;
        if (flies)
            look_around(session.camera, k_turn_rad_per_unit * glm::dvec2(moved.x, -moved.y));
        else if (pans)
            pan(session.camera, glm::dvec2(moved.x, -moved.y) / size.y);
        else
            orbit(session.camera, k_turn_rad_per_unit * glm::dvec2(-moved.x, moved.y));
    }
    if (io.MouseWheel != 0.0f && !io.WantCaptureMouse && !hovered_) {
        const double radius = session.bounds().radius;
        zoom(session.camera, std::pow(k_zoom_per_notch, double(io.MouseWheel)), k_nearest * radius,
             k_farthest * radius);
    }
}

bool ViewInput::fly_on(ViewSession& session) const {
    const ImGuiIO& io = ImGui::GetIO();
    if (!flies || io.WantTextInput) return false;
    const auto along = [&](int forwards, int backwards) {
        return (io.KeysDown[forwards] ? 1.0 : 0.0) - (io.KeysDown[backwards] ? 1.0 : 0.0);
    };
    const glm::dvec3 direction(along(GLFW_KEY_D, GLFW_KEY_A), along(GLFW_KEY_E, GLFW_KEY_Q),
                               along(GLFW_KEY_W, GLFW_KEY_S));
    if (direction == glm::dvec3(0.0)) return false;
    const double seconds = std::min(double(io.DeltaTime), k_longest_step_s);
    const double speed = k_fly_speed * session.bounds().radius * (io.KeyShift ? k_fast_times : 1.0);
    const glm::dvec3 step = seconds * speed * glm::normalize(direction);
    // Only as far out as silhouettes are found to.
    const Camera before = session.camera;
    fly(session.camera, step);
    const double reach = glm::distance(session.camera.eye, session.bounds().center);
    if (reach > 2.0 * k_farthest * session.bounds().radius) session.camera = before;
    return true;
}

bool ViewInput::apply(ViewSession& session, const glm::dvec2& size) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool any_down = io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2];
    const bool clicked =
        ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
    take_light(session, size);
    if (!any_down) holds_picture_ = false;
    if (clicked && !io.WantCaptureMouse && !held_) holds_picture_ = true;
    move_camera(session, size);
    const bool flying = fly_on(session);
    return flying || holds_picture_ || held_.has_value();
}

}  // namespace rimline::tools
