#include "tools/view/view_panel.h"

#include <imgui.h>
#include <imgui_internal.h>

#include "tests/tools/view/shown_window.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("the list of recent files is as wide as what the panel holds") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    shown.resize(900, 700);
    shown.capture();
    tests::move_mouse(shown.window, 110, 134);
    shown.loop->step(true);
    tests::click(shown.window, GLFW_MOUSE_BUTTON_LEFT);
    for (int frame = 0; frame < 4; ++frame) shown.loop->step(true);
    const ImGuiWindow* const panel = ImGui::FindWindowByName("Rimline");
    const ImGuiWindow* const list = ImGui::FindWindowByName("##Combo_00");
    REQUIRE(panel);
    REQUIRE(list);
    CHECK(list->Size.x == panel->WorkRect.GetWidth());
}
