// The window under Xvfb: what it shows is what `rimline render` draws, whatever happens to it.

#include "tools/view/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <thread>
#include <utility>

#include "engine/tested_device.h"
#include "tests/tools/scratch_folder.h"
#include "tests/tools/view/shown_window.h"
#include "tools/view/camera_motion.h"
#include "tools/view/coarseness.h"
#include "tools/view/screen_view.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

constexpr int k_width = tests::k_window_width;
constexpr int k_height = tests::k_window_height;

using Shown = tests::ShownWindow;
using tests::changed_pixels;
using tests::difference;

// Whether there is something to compare at all.
int contrast(const Picture& picture) {
    int least = 255;
    int greatest = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        least = std::min<int>(least, picture.rgba[i]);
        greatest = std::max<int>(greatest, picture.rgba[i]);
    }
    return greatest - least;
}

}  // namespace

TEST_CASE(
    "a window without its panel shows the picture that render draws, before and after resizes") {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = false});
    const Picture first = shown.capture();
    CHECK(contrast(first) > 100);
    CHECK(difference(first, shown.rendered(k_width, k_height)) <= 1);
    for (const auto& [width, height] : {std::pair{401, 203}, {160, 300}, {k_width, k_height}}) {
        shown.resize(width, height);
        const Picture resized = shown.capture();
        CHECK(resized.width == static_cast<std::uint32_t>(width));
        CHECK(difference(resized, shown.rendered(resized.width, resized.height)) <= 1);
    }
    CHECK(difference(first, shown.capture()) == 0);
}

TEST_CASE(
    "many frames of a moving camera, resized all along, are drawn without a word of validation") {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = false});
    for (int i = 0; i < 24; ++i) {
        if (i % 6 == 5) shown.window.set_size(200 + 13 * i, 240 - 5 * i);
        orbit(shown.session.camera, {0.1, 0.02});
        shown.loop->step(true);
    }
    const Picture last = shown.capture();
    CHECK(difference(last, shown.rendered(last.width, last.height)) <= 1);
}

TEST_CASE("a cloud in a window without its panel is the picture that points draws, as it turns") {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = false}, /*as_points=*/true);
    REQUIRE(shown.session.is_cloud());
    const Picture first = shown.capture();
    CHECK(contrast(first) > 100);
    CHECK(difference(first, shown.rendered(k_width, k_height)) <= 1);
    for (int i = 0; i < 6; ++i) {
        orbit(shown.session.camera, {0.15, 0.03});
        if (i == 2) shown.session.freeze();
        if (i == 4) shown.session.appearance.line_width_px = 4.0f;
        const Picture turned = shown.capture();
        CHECK(difference(turned, shown.rendered(k_width, k_height)) <= 1);
        CHECK(difference(turned, first) > 50);
    }
    shown.loop->renderer().recreate();
    shown.resize(401, 203);
    CHECK(difference(shown.capture(), shown.rendered(401, 203)) <= 1);
}

TEST_CASE("a picture that is drawn beside the one that is shown takes its place, or is given up") {
    RIMLINE_OPEN_DISPLAY(display);
    for (const bool as_points : {false, true}) {
        CAPTURE(as_points);
        Shown shown({.panel = false, .fits = false}, as_points);
        const Picture first = shown.capture();
        WindowRenderer& renderer = shown.loop->renderer();
        REQUIRE(renderer.has_kept_picture());
        orbit(shown.session.camera, {0.4, 0.1});
        const Picture turned = shown.rendered(k_width, k_height);
        REQUIRE(difference(turned, first) > 50);
        const auto draw_beside = [&](bool is_wanted) {
            FrameReport report;
            const ViewPicture picture =
                shown.session.picture(ImageSize{std::uint32_t(k_width), std::uint32_t(k_height)});
            return renderer.draw_beside(picture, {}, report, [&] { return is_wanted; });
        };
        const auto shows = [&] {
            std::optional<WindowRenderer::Frame> frame;
            while (!frame) frame = renderer.draw_kept({}, true);
            return frame->picture;
        };
        // It may be done before it is asked whether it is wanted.
        const WindowRenderer::Beside became = draw_beside(false);
        CHECK(became != WindowRenderer::Beside::impossible);
        CHECK(difference(shows(), became == WindowRenderer::Beside::done ? turned : first) <= 1);
        CHECK(draw_beside(true) == WindowRenderer::Beside::done);
        CHECK(difference(shows(), turned) <= 1);
        CHECK(difference(shows(), turned) <= 1);
        // A rehearsal shows nothing, wanted to its end or not.
        orbit(shown.session.camera, {0.4, 0.1});
        for (const bool is_wanted : {true, false, true}) {
            renderer.rehearse(shown.session.picture(std::nullopt),
                              {.scale = 1, .divisor = 3, .shadows = false},
                              [&] { return is_wanted; });
            CHECK(difference(shows(), turned) <= 1);
        }
        CHECK(draw_beside(true) == WindowRenderer::Beside::done);
        CHECK(difference(shows(), shown.rendered(k_width, k_height)) <= 1);
        // Of a window of another size there is none.
        shown.resize(401, 203);
        CHECK(draw_beside(true) == WindowRenderer::Beside::impossible);
        CHECK(difference(shown.capture(), shown.rendered(401, 203)) <= 1);
    }
}

TEST_CASE("after a lost device the window shows the same picture again") {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = false});
    const Picture before = shown.capture();
    for (std::uint32_t i = 1; i <= 2; ++i) {
        shown.loop->renderer().recreate();
        CHECK(shown.loop->renderer().recreation_count() == i);
        CHECK(difference(before, shown.capture()) == 0);
    }
}

TEST_CASE("a window of no size has no image, and has one again when it has a size") {
    RIMLINE_OPEN_DISPLAY(display);
    const Window window("test", k_width, k_height);
    const VulkanInstance instance({.window_extensions = window.vulkan_extensions()});
    const TestedDevice device(instance, tests::requested_device());
    const WindowSurface surface = window.make_surface(instance);
    Swapchain swapchain(device.context(), surface.get(), 1);
    CHECK_FALSE(swapchain.acquire(0, {0, 0}));
    CHECK_FALSE(swapchain.acquire(0, {k_width, 0}));
    CHECK(swapchain.extent().width == 0);
    REQUIRE(swapchain.acquire(0, {k_width, k_height}));
    CHECK(swapchain.extent().width == k_width);
    CHECK(swapchain.extent().height == k_height);
    // Its image is waited for, as a frame would.
    const VkSemaphoreSubmitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = swapchain.acquired(),
                                     .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .waitSemaphoreInfoCount = 1,
                               .pWaitSemaphoreInfos = &wait};
    CHECK(device.context().vk->QueueSubmit2(device.context().queue, 1, &submit, VK_NULL_HANDLE) ==
          VK_SUCCESS);
    device.context().vk->DeviceWaitIdle(device.context().device);
}

// As a window manager takes a minimized window off the screen, and puts it back.
void show_window(const Window& window, bool is_shown) {
    if (is_shown)
        glfwShowWindow(window.handle());
    else
        glfwHideWindow(window.handle());
    for (int attempt = 0; attempt < 400 && window.is_shown() != is_shown; ++attempt)
        glfwWaitEventsTimeout(0.01);
    REQUIRE(window.is_shown() == is_shown);
}

TEST_CASE("a window that is not shown draws nothing, and then the same picture again") {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = false});
    const Picture before = shown.capture();
    show_window(shown.window, false);
    CHECK(shown.window.size_px().width == 0);
    for (int turn = 0; turn < 10; ++turn) CHECK_FALSE(shown.loop->step(true));
    show_window(shown.window, true);
    CHECK(difference(before, shown.capture()) == 0);
}

TEST_CASE("a window that is not shown rests, whatever it has yet to draw") {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = true});
    CHECK(shown.loop->step(false));  // Coarse, and to be drawn finely soon.
    show_window(shown.window, false);
    while (shown.loop->gallery().is_finding())
        shown.loop->step(false);  // Its end wakes the window.
    for (int turn = 0; turn < 4; ++turn) shown.loop->step(false);
    const auto begun = std::chrono::steady_clock::now();
    for (int turn = 0; turn < 3; ++turn) CHECK_FALSE(shown.loop->step(false));
    CHECK(std::chrono::steady_clock::now() - begun > std::chrono::milliseconds(500));
}

TEST_CASE("the panel lies over the picture and leaves the rest of it as it is" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = true, .fits = false});
    shown.resize(900, 500);
    shown.session.lights = {{.vector = {0, 0, -1}, .directional = true}};
    const Picture with_panel = shown.capture_at_rest();
    const Picture picture = shown.rendered(900, 500);
    const auto [under_panel, beside_it] = changed_pixels(with_panel, picture);
    CHECK(under_panel > 10'000);
    // The sun's handle.
    CHECK(beside_it < 1'000);
}

TEST_CASE("the panel and Hough space are complete in the first frame" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_DISPLAY(display);
    for (const bool as_points : {false, true}) {
        CAPTURE(as_points);
        Shown shown({.panel = true, .inspector = true, .fits = false}, as_points);
        shown.resize(1000, 700);
        // Nothing beside the panels that may be finer later.
        shown.session.appearance.ground = false;
        pan(shown.session.camera, {40.0, 0.0});
        while (shown.loop->gallery().is_finding())
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        const Picture first = shown.capture();
        for (int frame = 0; frame < 4; ++frame) shown.capture();
        const Picture later = shown.capture_at_rest();
        REQUIRE(later.rgba.size() == first.rgba.size());
        std::size_t dark = 0, other = 0;
        const auto area = shown.loop->free_area();
        for (std::size_t i = 0; i < first.rgba.size(); i += 4) {
            const auto x = double(i / 4 % first.width);
            if (x > area.left && x < area.window.x - area.right) continue;
            dark += later.rgba[i] < 120;
            other += std::abs(int(first.rgba[i]) - int(later.rgba[i])) > 40;
        }
        CHECK(dark > 1'000);
        CHECK(other < dark / 20);
    }
}

Picture saved_picture(const char* file) {
    const std::string bytes = tests::read_bytes(file);
    return decode_png(std::as_bytes(std::span(bytes)));
}

// What is empty at the left and the right of a picture, as shares of its width.
std::pair<double, double> margins(const Picture& picture) {
    std::uint32_t first = picture.width, last = 0;
    for (std::uint32_t i = 0; i < picture.width * picture.height; ++i) {
        if (std::equal(&picture.rgba[4 * i], &picture.rgba[4 * i] + 4, picture.rgba.begin()))
            continue;
        first = std::min(first, i % picture.width);
        last = std::max(last, i % picture.width);
    }
    return {double(first) / picture.width, 1.0 - double(last + 1) / picture.width};
}

TEST_CASE(
    "keys are not lost however short they are pressed and P saves with the panel folded or hidden" *
    doctest::test_suite("plain")) {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = true});
    shown.capture();
    const bool had_ground = shown.session.appearance.ground;
    tests::tap_key(shown.window, GLFW_KEY_G);
    tests::tap_key(shown.window, GLFW_KEY_Z);
    shown.loop->step(true);
    CHECK(shown.session.appearance.ground == !had_ground);
    CHECK(shown.session.frozen());
    tests::ScratchFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder / "");
    for (int hidden = 0; hidden < 2; ++hidden) {
        const glm::dvec3 eye = shown.session.camera.eye;
        tests::tap_key(shown.window, GLFW_KEY_P);
        shown.loop->step(true);
        CHECK(shown.loop->message() == "saved view.png");
        CHECK(shown.session.camera.eye == eye);
        const auto [left, right] = margins(saved_picture("view.png"));
        CHECK(left > 0.01);
        CHECK(std::abs(left - right) < 0.03);
        CHECK(std::filesystem::remove("view.png"));
        tests::tap_key(shown.window, GLFW_KEY_TAB);
        shown.loop->step(true);
        shown.loop->step(true);  // The model is framed anew.
    }
    std::filesystem::current_path(before);
}

TEST_CASE("a file that the window has not written is replaced when it is saved again" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = true});
    shown.capture();
    tests::ScratchFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder / "");
    const auto size_after = [&](int key, const char* file) {
        tests::tap_key(shown.window, key);
        shown.loop->step(true);
        return std::filesystem::file_size(file);
    };
    for (const auto& [key, file] :
         {std::pair{GLFW_KEY_P, "view.png"}, {GLFW_KEY_X, "scene.json"}}) {
        CAPTURE(file);
        tests::write_bytes(file, "mine");
        CHECK(size_after(key, file) == 4);
        CHECK(shown.loop->message().find("exists") != std::string::npos);
        CHECK(size_after(key, file) > 4);
        CHECK(shown.loop->message().find("saved") != std::string::npos);
        tests::write_bytes(file, "");
        CHECK(size_after(key, file) > 4);
    }
    std::filesystem::current_path(before);
    // These are other programs' shortcuts.
    for (const int modifier : {GLFW_MOD_CONTROL, GLFW_MOD_ALT, GLFW_MOD_SUPER}) {
        tests::tap_key(shown.window, GLFW_KEY_Z, modifier);
        shown.loop->step(true);
        CHECK_FALSE(shown.session.frozen());
    }
    tests::tap_key(shown.window, GLFW_KEY_Z, GLFW_MOD_SHIFT);
    shown.loop->step(true);
    CHECK(shown.session.frozen());
}

TEST_CASE(
    "a framed model stays whole beside the panel and Hough space and in a window of another size" *
    doctest::test_suite("plain")) {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = true});
    shown.resize(1000, 600);
    shown.capture();
    const auto is_whole = [&] {
        const FreeArea area = shown.loop->free_area();
        const ScreenView view(shown.session.camera, area.window);
        return std::ranges::all_of(shown.session.model().mesh().positions(), [&](glm::vec3 p) {
            const auto pixel = view.pixel_of(glm::dvec3(p));
            return pixel && pixel->x > area.left && pixel->x < area.window.x - area.right &&
                   pixel->y > 0.0 && pixel->y < area.window.y;
        });
    };
    CHECK(is_whole());
    CHECK(shown.loop->free_area().left > 300.0);
    tests::tap_key(shown.window, GLFW_KEY_I);
    shown.capture();
    shown.capture();
    CHECK(shown.loop->free_area().right > 200.0);
    CHECK(is_whole());
    for (const auto& [width, height] : {std::pair{900, 800}, {1200, 400}}) {
        shown.resize(width, height);
        shown.capture();
        CHECK(is_whole());
    }
    // The user's own view stays.
    shown.session.camera.eye += glm::dvec3(0.1, 0.0, 0.0);
    shown.capture();
    const Camera own = shown.session.camera;
    shown.capture();
    CHECK(shown.session.camera.eye == own.eye);
}

TEST_CASE("coarse pictures of fewer pixels fill the window as the fine one does") {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = false});
    const Picture fine = shown.capture();
    for (const std::uint32_t divisor : {2u, 3u}) {
        const auto frame = shown.loop->renderer().draw(shown.session.picture(), {},
                                                       {.scale = 1, .divisor = divisor}, true);
        REQUIRE(frame);
        REQUIRE(frame->picture.width == fine.width);
        REQUIRE(frame->picture.height == fine.height);
        // Edges are blurred; most of the pixels are the same.
        std::size_t alike = 0;
        for (std::size_t i = 0; i < fine.rgba.size(); i += 4)
            alike += std::abs(int(fine.rgba[i]) - int(frame->picture.rgba[i])) < 24;
        CHECK(alike > fine.rgba.size() / 4 * 3 / 4);
        CHECK(difference(fine, frame->picture) > 50);
    }
    const auto again = shown.loop->renderer().draw(
        shown.session.picture(ImageSize{k_width, k_height}), {}, {}, true);
    REQUIRE(again);
    CHECK(difference(fine, again->picture) == 0);
}

// The mouse comes to a place of the window.
void point_at(const Window& window, double x, double y) {
    const GLFWcursorposfun handler = glfwSetCursorPosCallback(window.handle(), nullptr);
    handler(window.handle(), x, y);
    glfwSetCursorPosCallback(window.handle(), handler);
}

TEST_CASE("while the mouse moves over the panel the picture stays as fine as it is") {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = true});
    shown.resize(900, 500);
    const Picture fine = shown.capture_at_rest();
    const std::size_t frames = shown.loop->picture_count();
    for (int i = 0; i < 12; ++i) {
        point_at(shown.window, 100.0 + 5.0 * i, 40.0 + 20.0 * i);
        const Picture kept = shown.capture();
        CHECK_FALSE(shown.loop->is_coarse());
        CHECK(changed_pixels(fine, kept)[1] == 0);
    }
    CHECK(shown.loop->picture_count() == frames);
    // What the picture shows changes it.
    shown.session.appearance.line_width_px *= 2.0f;
    CHECK(changed_pixels(fine, shown.capture())[1] > 100);
    shown.capture_at_rest();
    shown.resize(901, 500);
    CHECK(shown.capture().width == 901);
    // One that is lost is drawn again.
    const Picture wide = shown.capture_at_rest();
    shown.loop->renderer().recreate();
    CHECK(changed_pixels(wide, shown.capture_at_rest())[1] == 0);
}

TEST_CASE("while a model of many faces moves on a slow device one of few stands in for it" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_DISPLAY(display);
    Shown shown({.panel = true});
    shown.resize(900, 500);
    const auto open = [&](const std::string& name) {
        shown.loop->open({name});
        for (int i = 0; i < 2000 && shown.session.document().name() != name; ++i)
            shown.loop->step(true);
        REQUIRE(shown.session.document().name() == name);
    };
    open("shape:torus:60000");
    if (!Coarseness(shown.loop->renderer().device_facts().type == VK_PHYSICAL_DEVICE_TYPE_CPU)
             .is_slow_device()) {
        CHECK(shown.session.model().reduced() == nullptr);
        return;
    }
    for (int i = 0; i < 2000 && shown.session.model().reduced() == nullptr; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        shown.loop->step(true);
    }
    const ReducedModel* const reduced = shown.session.model().reduced();
    REQUIRE(reduced != nullptr);
    CHECK(reduced->mesh().face_count() <= ReducedModel::k_faces);
    const Picture fine = shown.capture_at_rest();
    orbit(shown.session.camera, {1e-4, 0.0});
    tests::tap_key(shown.window, GLFW_KEY_LEFT_SHIFT);
    const Picture coarse = shown.capture();
    REQUIRE(shown.loop->is_coarse());
    constexpr std::uint64_t k_most_bytes_a_face = 100;
    CHECK(shown.loop->report().meshes_uploaded == 1);
    CHECK(shown.loop->report().bytes_uploaded < ReducedModel::k_faces * k_most_bytes_a_face);
    CHECK(shown.loop->report().bytes_uploaded > 0);
    // They look alike.
    std::size_t other = 0;
    for (std::size_t i = 0; i < fine.rgba.size(); i += 4)
        other += std::abs(int(fine.rgba[i]) - int(coarse.rgba[i])) > 100;
    CHECK(other < fine.rgba.size() / 4 / 50);
    // At rest it has all of its faces again.
    shown.capture_at_rest();
    // Both stay on the device.
    CHECK(shown.loop->report().meshes_uploaded == 0);
    const auto moves = [&] {
        orbit(shown.session.camera, {1e-4, 0.0});
        tests::tap_key(shown.window, GLFW_KEY_LEFT_SHIFT);
        shown.capture();
        REQUIRE(shown.loop->is_coarse());
        return shown.loop->report().meshes_uploaded;
    };
    CHECK(moves() == 0);
    // Where nothing has happened for a moment, it is there before it is needed.
    for (const bool waits : {false, true}) {
        shown.capture_at_rest();
        shown.loop->renderer().recreate();
        shown.capture_at_rest();
        for (int i = 0; waits && i < 500 && !shown.loop->is_at_rest(); ++i) shown.loop->step(false);
        CHECK(moves() == (waits ? 0 : 1));
    }
    // What is done for a model ends with it.
    open("shape:knot:50000");
    open("shape:box");
    CHECK(shown.session.model().reduced() == nullptr);
}

TEST_CASE("a moving picture gets coarser while its frames are slow, and finer again") {
    Coarseness slow(true), fast(false);
    CHECK(fast.quality().scale == 0);
    CHECK(slow.quality().scale == 1);
    CHECK(slow.quality().divisor == 1);
    std::uint32_t divisor = 1;
    // Two of its slow frames are an answer within a tenth of a second.
    CHECK(2.0 * Coarseness::k_slow_ms < 100.0);
    for (int frame = 0; frame < 10; ++frame) {
        slow.add(400.0);
        CHECK(slow.quality().divisor >= divisor);
        divisor = slow.quality().divisor;
    }
    CHECK(divisor == 3);
    CHECK_FALSE(slow.quality().shadows);
    // In time, but not so fast that four times as many pixels would be.
    for (int frame = 0; frame < 200; ++frame) slow.add(30.0);
    CHECK_FALSE(slow.quality().shadows);
    // A finer picture that was too slow is not tried again at once.
    slow.add(5.0);
    CHECK(slow.quality().shadows);
    slow.add(60.0);
    for (int frame = 0; frame < 30; ++frame) slow.add(5.0);
    CHECK_FALSE(slow.quality().shadows);
    for (int frame = 0; frame < 100; ++frame) slow.add(5.0);
    CHECK(slow.quality().scale == 0);
    CHECK(slow.quality().shadows);
}

TEST_CASE("the first frames of a moving picture are coarse if the picture at rest was slow") {
    Coarseness coarseness(true);
    coarseness.add_fine(50.0);
    CHECK(coarseness.quality().divisor == 1);
    coarseness.add_fine(150.0);
    CHECK(coarseness.quality().divisor == 3);
    CHECK_FALSE(coarseness.quality().shadows);
    coarseness.add(10.0);
    CHECK(coarseness.quality().shadows);
    Coarseness fast(false);
    fast.add_fine(150.0);
    CHECK(fast.quality().scale == 0);
}

TEST_CASE("a window has room for its panel and fits on the screen, which is 1600 x 1200") {
    RIMLINE_OPEN_DISPLAY(display);
    constexpr Window::Least k_least{.width = 800, .height = 600};
    const auto size_of = [](int width, int height, std::optional<Window::Least> least) {
        return Window("test", width, height, least).size();
    };
    CHECK(size_of(160, 120, k_least) == glm::dvec2(800, 600));
    CHECK(size_of(1000, 700, k_least) == glm::dvec2(1000, 700));
    CHECK(size_of(9000, 6750, k_least) == glm::dvec2(1440, 1080));
    CHECK(size_of(9000, 90, k_least) == glm::dvec2(1440, 600));
    CHECK(size_of(160, 120, Window::Least{}) == glm::dvec2(160, 120));
    CHECK(size_of(160, 120, std::nullopt) == glm::dvec2(160, 120));
    CHECK(size_of(160, 120, Window::Least{3000, 3000}) == glm::dvec2(1440, 1080));
}

TEST_CASE("without a display the error says what to set and what else to use") {
    unsetenv("WAYLAND_DISPLAY");
    setenv("DISPLAY", ":67890", 1);
    try {
        const Window window("test", k_width, k_height);
        FAIL("there is no such display");
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK(error.code() == ErrorCode::no_device);
        CHECK(message.find("DISPLAY") != std::string::npos);
        CHECK(message.find("rimline render") != std::string::npos);
    }
}
