#include "tools/view/hough_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "tools/view/camera_motion.h"
#include "tools/view/screen_view.h"

namespace rimline::tools {

namespace {

constexpr ImU32 k_inside = IM_COL32(38, 98, 168, 255);
constexpr ImU32 k_outside = IM_COL32(118, 118, 122, 255);
constexpr ImU32 k_tested = IM_COL32(206, 74, 24, 255);
constexpr ImU32 k_paper = IM_COL32(253, 251, 246, 255);
constexpr ImU32 k_sphere = IM_COL32(30, 34, 46, 90);
constexpr ImU32 k_ink = IM_COL32(30, 34, 46, 255);

ImU32 with_alpha(ImU32 color, std::uint32_t alpha) {
    return (color & ~IM_COL32_A_MASK) | alpha << IM_COL32_A_SHIFT;
}

// Draws positions of Hough space inside a rectangle of the panel.
class Space {
public:
    Space(ImDrawList& list, const Camera& camera, ImVec2 low, ImVec2 size)
        : list_(list), view_(camera, {size.x, size.y}), low_(low) {}

    std::optional<ImVec2> project(const glm::dvec3& p) const {
        const std::optional<glm::dvec2> pixel = view_.pixel_of(p);
        // Points near the eye's plane are projected far outside the panel.
        if (!pixel || std::abs(pixel->x) > 1e5 || std::abs(pixel->y) > 1e5) return std::nullopt;
        return ImVec2(low_.x + float(pixel->x), low_.y + float(pixel->y));
    }

    void line(const glm::dvec3& a, const glm::dvec3& b, ImU32 color, float width) const {
        const auto from = project(a);
        const auto to = project(b);
        if (from && to) list_.AddLine(*from, *to, color, width);
    }

    void dot(const glm::dvec3& p, ImU32 color, float half) const {
        if (const auto at = project(p))
            list_.AddRectFilled({at->x - half, at->y - half}, {at->x + half, at->y + half}, color);
    }

    // A circle around `center` in the plane of two unit vectors.
    void circle(const glm::dvec3& center, const glm::dvec3& a, const glm::dvec3& b, double radius,
                ImU32 color, float width) const {
        constexpr int k_steps = 72;
        glm::dvec3 before = center + radius * a;
        for (int i = 1; i <= k_steps; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / k_steps;
            const glm::dvec3 next = center + radius * (std::cos(angle) * a + std::sin(angle) * b);
            line(before, next, color, width);
            before = next;
        }
    }

    void box(const WalkedBox& box, ImU32 color) const {
        std::array<std::optional<ImVec2>, 8> corners;
        for (std::size_t i = 0; i < 8; ++i) {
            const glm::dvec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1,
                                  (i & 4) != 0 ? 1 : -1);
            corners[i] = project(glm::dvec3(box.center) + sign * glm::dvec3(box.extent));
            if (!corners[i]) return;
        }
        for (std::size_t i = 0; i < 8; ++i)
            for (const std::size_t axis : {1u, 2u, 4u})
                if ((i & axis) == 0) list_.AddLine(*corners[i], *corners[i | axis], color, 1.0f);
    }

private:
    ImDrawList& list_;
    ScreenView view_;
    ImVec2 low_;
};

// Two unit vectors perpendicular to `axis` and to each other.
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& axis) {
    const glm::dvec3 seed = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 a = glm::normalize(glm::cross(axis, seed));
    return {a, glm::cross(axis, a)};
}

void draw_v_sphere(const Space& space, const HoughInspection& inspection) {
    const glm::dvec3 pole(inspection.pole());
    const glm::dvec3 axis = glm::normalize(pole);
    const auto [a, b] = across(axis);
    if (inspection.is_plane()) {
        // The plane H . q = 0, as a disc around the origin.
        for (const double radius : {0.4, 0.8, 1.2}) space.circle({}, a, b, radius, k_sphere, 1.0f);
        for (int i = 0; i < 6; ++i) {
            const double angle = std::numbers::pi * i / 6.0;
            const glm::dvec3 spoke = 1.2 * (std::cos(angle) * a + std::sin(angle) * b);
            space.line(-spoke, spoke, k_sphere, 1.0f);
        }
        space.line({}, axis * 1.2, k_ink, 1.5f);
        return;
    }
    const glm::dvec3 center = 0.5 * pole;
    const double radius = glm::length(center);
    constexpr int k_meridians = 6;
    for (int i = 0; i < k_meridians; ++i) {
        const double angle = std::numbers::pi * i / k_meridians;
        space.circle(center, axis, std::cos(angle) * a + std::sin(angle) * b, radius, k_sphere,
                     1.0f);
    }
    constexpr int k_parallels = 9;
    for (int i = 1; i < k_parallels; ++i) {
        const double angle = std::numbers::pi * i / k_parallels;
        space.circle(center + radius * std::cos(angle) * axis, a, b, radius * std::sin(angle),
                     k_sphere, 1.0f);
    }
    space.line({}, pole, k_ink, 1.5f);
    space.dot(pole, k_ink, 3.0f);
}

// Of the next item: in this line if it fits, else in the next one.
void flow(const char* text, float beside_text) {
    ImGui::SameLine();
    const float width = ImGui::CalcTextSize(text).x + beside_text;
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void check_box(const char* text, bool* is_on, bool starts_line = false) {
    if (!starts_line) flow(text, ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::Checkbox(text, is_on);
}

void legend(ImU32 color, const char* text) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = 0.6f * ImGui::GetFontSize();
    const float drop = 0.5f * (ImGui::GetFontSize() - side);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + drop},
                                              {at.x + side, at.y + drop + side}, color, 2.0f);
    ImGui::Dummy({side, ImGui::GetFontSize()});
    ImGui::SameLine(0.0f, 4.0f);
    ImGui::TextUnformatted(text);
}

}  // namespace

void HoughPanel::draw(const HoughInspection& inspection, float x, float y, float width,
                      float height) {
    if (!open) return;
    // The user may move it, until the main window has another size.
    const std::array<float, 4> place{x, y, width, height};
    const ImGuiCond when =
        std::exchange(place_, place) == place ? ImGuiCond_FirstUseEver : ImGuiCond_Always;
    ImGui::SetNextWindowPos({x, y}, when);
    ImGui::SetNextWindowSize({width, height}, when);
    if (!ImGui::Begin("Hough space", &open, ImGuiWindowFlags_NoCollapse)) {
        ImGui::End();
        return;
    }
    const HoughInspection::Blocks& blocks = inspection.blocks();
    char text[96];
    std::snprintf(text, sizeof text, "inside %u", blocks.inside);
    legend(k_inside, text);
    std::snprintf(text, sizeof text, "outside %u", blocks.outside);
    flow(text, ImGui::GetFontSize());
    legend(k_outside, text);
    std::snprintf(text, sizeof text, "looked at %u of %u blocks", blocks.tested, blocks.all);
    flow(text, ImGui::GetFontSize());
    legend(k_tested, text);
    check_box("points", &shows_points_, true);
    check_box("v-sphere", &shows_sphere_);
    check_box("looked at", &shows_tested_);
    check_box("settled", &shows_settled_);

    const ImVec2 low = ImGui::GetCursorScreenPos();
    ImVec2 size = ImGui::GetContentRegionAvail();
    size.y -= ImGui::GetTextLineHeightWithSpacing();
    if (size.x > 20.0f && size.y > 20.0f) {
        ImGui::InvisibleButton("space", size);
        const ImGuiIO& io = ImGui::GetIO();
        if (ImGui::IsItemActive())
            orbit(camera_, 0.008 * glm::dvec2(-io.MouseDelta.x, io.MouseDelta.y));
        if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f)
            zoom(camera_, std::pow(0.9, double(io.MouseWheel)), 0.2, 20.0);
        const ImVec2 high{low.x + size.x, low.y + size.y};
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(low, high, k_paper, 3.0f);
        list.PushClipRect(low, high, true);
        // There are thousands of short lines: antialiasing costs more than it improves.
        const ImDrawListFlags before = list.Flags;
        list.Flags &= ~(ImDrawListFlags_AntiAliasedLines | ImDrawListFlags_AntiAliasedFill);
        const Space space(list, camera_, low, size);
        // Many boxes are drawn with a lower opacity, so that the points stay visible.
        const std::uint32_t box_alpha =
            std::clamp(40'000u / std::max(inspection.blocks().tested, 1u), 36u, 150u);
        for (const WalkedBox& box : inspection.boxes()) {
            if (!box.is_end()) continue;
            const bool tested = box.side == WalkedBox::Side::straddles;
            if (tested ? !shows_tested_ : !shows_settled_) continue;
            const ImU32 color = tested                                ? k_tested
                                : box.side == WalkedBox::Side::inside ? k_inside
                                                                      : k_outside;
            space.box(box, with_alpha(color, tested ? box_alpha : 60u));
        }
        if (shows_points_)
            for (const HoughInspection::Point& point : inspection.points())
                space.dot(glm::dvec3(point.position), point.inside ? k_inside : k_outside, 1.2f);
        list.Flags = before;
        if (shows_sphere_) draw_v_sphere(space, inspection);
        space.dot({}, k_ink, 2.5f);
        if (const auto origin = space.project({}))
            list.AddText({origin->x + 6.0f, origin->y - 6.0f}, k_ink, "O");
        if (!inspection.is_plane())
            if (const auto pole = space.project(glm::dvec3(inspection.pole())))
                list.AddText({pole->x + 6.0f, pole->y - 6.0f}, k_ink, "q");
        list.PopClipRect();
    }
    if (inspection.points().size() < inspection.point_count())
        ImGui::TextDisabled("%zu of %u points; drag to turn", inspection.points().size(),
                            inspection.point_count());
    else
        ImGui::TextDisabled("%u points; drag to turn", inspection.point_count());
    ImGui::End();
}

}  // namespace rimline::tools
