#include "tools/view/view_marks.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "tools/view/camera_motion.h"
#include "tools/view/light_handles.h"
#include "tools/view/screen_view.h"

namespace rimline::tools {

namespace {

constexpr ImU32 k_mark_ink = IM_COL32(30, 34, 46, 255);
constexpr ImU32 k_halo = IM_COL32(255, 253, 248, 210);
constexpr ImU32 k_flame = IM_COL32(242, 158, 38, 255);
constexpr ImU32 k_chosen = IM_COL32(206, 74, 24, 255);
constexpr ImU32 k_frozen = IM_COL32(24, 110, 190, 255);

ImVec2 vec(const glm::dvec2& p) { return {float(p.x), float(p.y)}; }

// Draws a wider pale stroke below, so that the stroke is visible on every background.
void stroke(ImDrawList& list, const glm::dvec2& a, const glm::dvec2& b, ImU32 color, float width) {
    list.AddLine(vec(a), vec(b), k_halo, width + 2.5f);
    list.AddLine(vec(a), vec(b), color, width);
}

void draw_sun(ImDrawList& list, const glm::dvec2& at, bool chosen) {
    constexpr int k_rays = 8;
    const ImU32 fill = chosen ? k_chosen : k_flame;
    for (int i = 0; i < k_rays; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / k_rays;
        const glm::dvec2 way(std::cos(angle), std::sin(angle));
        stroke(list, at + 9.5 * way, at + 13.5 * way, k_mark_ink, 1.8f);
    }
    list.AddCircleFilled(vec(at), 8.5f, k_halo);
    list.AddCircleFilled(vec(at), 6.5f, fill);
    list.AddCircle(vec(at), 6.5f, k_mark_ink, 0, 1.5f);
}

void draw_lamp(ImDrawList& list, const glm::dvec2& at, bool chosen) {
    list.AddCircleFilled(vec(at), 9.5f, k_halo);
    list.AddCircleFilled(vec(at), 7.0f, chosen ? k_chosen : k_flame);
    list.AddCircle(vec(at), 7.0f, k_mark_ink, 0, 1.5f);
    stroke(list, at + glm::dvec2(-3.5, 10.5), at + glm::dvec2(3.5, 10.5), k_mark_ink, 1.8f);
    stroke(list, at + glm::dvec2(-2.0, 13.5), at + glm::dvec2(2.0, 13.5), k_mark_ink, 1.8f);
}

// Outwards from a handle that lies outside of the area.
void draw_arrow(ImDrawList& list, const glm::dvec2& at, const glm::dvec2& outwards) {
    const glm::dvec2 way = glm::normalize(outwards);
    const glm::dvec2 side(-way.y, way.x);
    const glm::dvec2 tip = at + 23.0 * way, foot = at + 16.0 * way;
    stroke(list, tip, foot + 5.0 * side, k_mark_ink, 1.8f);
    stroke(list, tip, foot - 5.0 * side, k_mark_ink, 1.8f);
}

void draw_lights(ImDrawList& list, const ViewSession& session, const ScreenView& view,
                 const FreeArea& area, std::optional<std::size_t> chosen) {
    const SceneBounds bounds = session.bounds();
    const auto [low, high] = area.corners(k_handle_margin);
    for (std::size_t i = 0; i < session.lights.size(); ++i) {
        const Light& light = session.lights[i];
        const glm::dvec3 handle = light_handle(light, bounds);
        const ShownHandle shown = shown_handle(light, bounds, view, low, high);
        const glm::dvec2 at = shown.pixel;
        if (shown.is_outside()) {
            draw_arrow(list, at, shown.outwards);
        } else if (light.directional) {
            // A stroke in the direction of the light.
            const glm::dvec3 inwards = glm::normalize(bounds.center - handle);
            const auto tip = view.pixel_of(handle + 0.3 * bounds.radius * inwards);
            if (tip && glm::distance(*tip, at) > 18.0)
                stroke(list, at + 16.0 * glm::normalize(*tip - at), *tip, k_mark_ink, 1.5f);
        }
        if (light.directional)
            draw_sun(list, at, chosen == i);
        else
            draw_lamp(list, at, chosen == i);
    }
}

// The silhouette point with the view pyramid of its camera; a box if the camera is orthographic.
void draw_frozen(ImDrawList& list, const Camera& frozen, const ScreenView& view,
                 const FreeArea& area, double reach) {
    const double aspect = area.window.x / area.window.y;
    const glm::dmat3 axes = glm::transpose(camera_from_world(frozen));
    const double half_height = frozen.is_orthographic()
                                   ? 0.5 * frozen.ortho_height
                                   : reach * std::tan(0.5 * glm::radians(frozen.fov_y_deg));
    std::array<std::optional<glm::dvec2>, 4> near;
    std::array<std::optional<glm::dvec2>, 4> far;
    for (std::size_t i = 0; i < 4; ++i) {
        const double x = i == 0 || i == 3 ? -1.0 : 1.0;
        const double y = i < 2 ? -1.0 : 1.0;
        const glm::dvec3 corner = half_height * (aspect * x * axes[0] + y * axes[1]);
        near[i] = view.pixel_of(frozen.is_orthographic() ? frozen.eye + corner : frozen.eye);
        far[i] = view.pixel_of(frozen.eye + corner - reach * axes[2]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        if (near[i] && far[i]) stroke(list, *near[i], *far[i], k_frozen, 1.5f);
        if (far[i] && far[next]) stroke(list, *far[i], *far[next], k_frozen, 1.5f);
        if (frozen.is_orthographic() && near[i] && near[next])
            stroke(list, *near[i], *near[next], k_frozen, 1.5f);
    }
    const auto eye = view.pixel_of(frozen.eye);
    if (!eye) return;
    list.AddCircleFilled(vec(*eye), 7.0f, k_halo);
    list.AddCircleFilled(vec(*eye), 5.0f, k_frozen);
    const char* text = frozen.is_orthographic() ? "silhouette direction" : "silhouette point";
    const ImVec2 text_size = ImGui::CalcTextSize(text);
    const ImVec2 text_position = vec(label_corner(*eye, {text_size.x, text_size.y}, area));
    for (const ImVec2 off : {ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1)})
        list.AddText({text_position.x + off.x, text_position.y + off.y}, k_halo, text);
    list.AddText(text_position, k_frozen, text);
}

}  // namespace

glm::dvec2 label_corner(const glm::dvec2& mark, const glm::dvec2& size, const FreeArea& area) {
    constexpr double k_gap = 11.0;
    const bool has_room = mark.x + k_gap + size.x <= area.window.x - area.right;
    return {has_room ? mark.x + k_gap : mark.x - k_gap - size.x, mark.y - 0.5 * size.y};
}

void draw_marks(const ViewSession& session, const FreeArea& area,
                std::optional<std::size_t> chosen) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ScreenView view(session.shown_camera(area), area.window);
    if (session.frozen())
        draw_frozen(list, *session.frozen(), view, area, 0.5 * session.bounds().radius);
    if (!session.is_cloud()) draw_lights(list, session, view, area, chosen);
}

void draw_axes(const Camera& camera, const FreeArea& area) {
    constexpr double k_length = 26.0;
    constexpr std::array<ImU32, 3> k_colors{IM_COL32(190, 60, 40, 255), IM_COL32(60, 140, 50, 255),
                                            IM_COL32(40, 90, 190, 255)};
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const glm::dvec2 center(area.left + 44.0, area.window.y - 44.0);
    const glm::dmat3 to_axes = camera_from_world(camera);
    // From the farthest to the nearest.
    std::array<int, 3> order{0, 1, 2};
    std::ranges::sort(order, {}, [&](int axis) { return to_axes[axis].z; });
    for (const int axis : order) {
        const glm::dvec2 end = center + k_length * glm::dvec2(to_axes[axis].x, -to_axes[axis].y);
        const ImU32 color = k_colors[static_cast<std::size_t>(axis)];
        stroke(list, center, end, color, 2.0f);
        const glm::dvec2 along = end - center;
        const glm::dvec2 beyond =
            glm::length(along) > 4.0 ? 9.0 * glm::normalize(along) : glm::dvec2(9.0, 0.0);
        const char name[2] = {static_cast<char>('x' + axis), '\0'};
        list.AddText(vec(end + beyond - glm::dvec2(4.0, 8.0)), color, name);
    }
}

}  // namespace rimline::tools
