#include "tools/view/view_input.h"

#include <glm/geometric.hpp>

#include "tests/tools/view/shown_window.h"
#include "tools/view/screen_view.h"
#include "tools/view/view_arguments.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("what is dragged to pan a given picture beside the panel stays under the mouse") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true, .fits = false});
    shown.resize(900, 500);
    ViewSession& session = shown.session;
    // A wide picture, which is small beside the panel.
    session.show(open_view({"shape:box", "--eye=0,0,4", "--target=0,0,0", "--size=800x200"},
                           [](const std::string&) { return LongCall{}; })
                     .view);
    shown.capture();
    const auto target_pixel = [&] {
        const FreeArea area = shown.loop->free_area();
        return *ScreenView(session.shown_camera(area), area.window).pixel_of(glm::dvec3(0.0));
    };
    CHECK(glm::distance(target_pixel(), glm::dvec2(610, 250)) < 1.0);
    tests::move_mouse(shown.window, 610, 250);
    shown.loop->step(true);
    tests::click(shown.window, GLFW_MOUSE_BUTTON_RIGHT);
    tests::move_mouse(shown.window, 680, 200);
    shown.loop->step(true);
    CHECK(glm::distance(target_pixel(), glm::dvec2(680, 200)) < 1.0);
}

TEST_CASE(
    "what the mouse moves before a button is pressed and after it is released drags nothing") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    shown.resize(900, 500);
    ViewSession& session = shown.session;
    session.show(open_view({"shape:box"}, [](const std::string&) { return LongCall{}; }).view);
    shown.capture();
    const auto eye_after = [&](const auto& input) {
        tests::move_mouse(shown.window, 500, 200);
        shown.loop->step(true);
        const glm::dvec3 before = session.camera.eye;
        input();
        shown.loop->step(true);
        shown.loop->step(true);
        return glm::distance(session.camera.eye, before);
    };
    // All of it in one frame.
    CHECK(eye_after([&] {
              tests::move_mouse(shown.window, 700, 350);
              tests::click(shown.window, GLFW_MOUSE_BUTTON_LEFT);
          }) == 0.0);
    CHECK(eye_after([&] {
              tests::move_mouse(shown.window, 700, 350);
              tests::click(shown.window, GLFW_MOUSE_BUTTON_LEFT);
              tests::release(shown.window, GLFW_MOUSE_BUTTON_LEFT);
              tests::move_mouse(shown.window, 550, 300);
          }) == 0.0);
    CHECK(eye_after([&] {
              tests::click(shown.window, GLFW_MOUSE_BUTTON_LEFT);
              tests::move_mouse(shown.window, 700, 350);
          }) > 0.1);
}
