// What the user does in the window: files, models, views, lights and look.

#include "tools/view/view_loop.h"

#include <dlfcn.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <glm/geometric.hpp>
#include <span>
#include <thread>

#include "tests/tools/scratch_folder.h"
#include "tests/tools/view/shown_window.h"
#include "tools/view/camera_motion.h"
#include "tools/view/view_arguments.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("a model opened in the window takes the other's place, and a broken one does not") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    const auto load = [&](const std::string& name) {
        shown.loop->open({name});
        for (int turn = 0; turn < 2000 && shown.loop->is_loading(); ++turn) shown.loop->step(true);
        shown.loop->step(true);
        shown.loop->step(true);
    };
    load("shape:torus:2000");
    CHECK(shown.session.model().name() == "shape:torus:2000");
    CHECK(shown.loop->message().empty());
    tests::ScratchFolder folder;
    tests::write_bytes(folder / "broken.obj", "v 0 0 0\nf 1 2 3\n");
    load((folder / "broken.obj").string());
    CHECK(shown.session.model().name() == "shape:torus:2000");
    CHECK(shown.loop->message().find("broken.obj") != std::string::npos);
    load("shape:box");
    CHECK(shown.session.model().name() == "shape:box");
    CHECK(shown.loop->message().empty());
}

TEST_CASE("that the first of several files was opened is told of those files alone") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    const auto load = [&] {
        for (int turn = 0; turn < 2000 && shown.loop->is_loading(); ++turn) shown.loop->step(true);
        shown.loop->step(true);
    };
    const std::vector<std::string> two{"shape:box", "shape:torus:2000"};
    shown.loop->open(two);
    load();
    CHECK(shown.loop->message().find("the first of 2 files") != std::string::npos);
    shown.loop->open(two);
    shown.loop->open({"shape:torus:2000"});
    load();
    CHECK(shown.session.model().name() == "shape:torus:2000");
    CHECK(shown.loop->message().empty());
}

TEST_CASE("a model is added in the window beside the other, seen by the same camera") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    shown.resize(900, 700);
    shown.capture_at_rest();
    const glm::dvec3 direction =
        glm::normalize(shown.session.camera.eye - shown.session.camera.target);
    REQUIRE(shown.session.has_chosen_sun());
    const std::size_t faces = shown.session.model().mesh().face_count();
    shown.loop->open({"shape:box", "shape:box"}, true);
    for (int i = 0; i < 2000 && shown.session.model().models().size() < 3; ++i)
        shown.loop->step(true);
    REQUIRE(shown.session.model().models().size() == 3);
    CHECK(shown.session.model().mesh().face_count() == faces + 24);
    CHECK(glm::distance(glm::normalize(shown.session.camera.eye - shown.session.camera.target),
                        direction) < 1e-6);
    CHECK(shown.session.has_chosen_sun());
    CHECK(shown.session.is_whole(shown.loop->free_area()));
    CHECK(shown.session.command({320, 240}, "a.png").find("--at") != std::string::npos);
    shown.loop->open({"scene.json"}, true);
    CHECK(shown.loop->message().find("cannot be added") != std::string::npos);
}

TEST_CASE("a model that was added or removed goes and comes back when that is undone") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    shown.capture();
    const auto models = [&] { return shown.session.model().models(); };
    const auto step_until = [&](std::size_t count) {
        for (int i = 0; i < 2000 && models().size() != count; ++i) shown.loop->step(true);
        shown.loop->step(true);
        REQUIRE(models().size() == count);
    };
    const auto press = [&](int key, int modifiers) {
        tests::tap_key(shown.window, key, modifiers);
        shown.loop->step(true);
    };
    const std::vector<PlacedModel> one = models();
    shown.loop->open({"shape:box"}, true);
    step_until(2);
    const std::vector<PlacedModel> two = models();
    const bool had_ground = shown.session.appearance.ground;
    shown.loop->arrange({two[1]}, /*has_new_first=*/true);
    step_until(1);
    CHECK(models()[0] == two[1]);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    step_until(2);
    CHECK(models() == two);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
    step_until(1);
    CHECK(models()[0] == two[1]);
    // Two at once, of which the first is not waited for.
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    for (int i = 0; i < 2000 && models() != one; ++i) shown.loop->step(true);
    shown.loop->step(true);
    CHECK(models() == one);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    CHECK(shown.loop->message() == "nothing to undo");
    // A change that is not there yet is the last one.
    shown.session.appearance.ground = !had_ground;
    shown.loop->step(true);
    shown.loop->open({"shape:knot:200000"}, true);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    CHECK_FALSE(shown.loop->is_loading());
    CHECK(shown.session.appearance.ground == !had_ground);
    CHECK(models() == one);
}

// Steps without events until nothing is due.
static void settle(ViewLoop& loop) {
    for (int step = 0; step < 500; ++step)
        if (!loop.step(false) && !loop.is_coarse()) return;
    FAIL("it does not rest");
}

// Another program that moves the mouse to the middle of the window, or beside it. GLFW has the library loaded.
class OtherProgram {
public:
    explicit OtherProgram(const Window& window) {
        int x = 0, y = 0;
        glfwGetWindowPos(window.handle(), &x, &y);
        x_ = x + static_cast<int>(window.size().x) / 2;
        y_ = y + static_cast<int>(window.size().y) / 2;
        display_ = call<void*(const char*)>("XOpenDisplay")(nullptr);
        REQUIRE(display_ != nullptr);
    }
    ~OtherProgram() { call<int(void*)>("XCloseDisplay")(display_); }
    OtherProgram(const OtherProgram&) = delete;
    OtherProgram& operator=(const OtherProgram&) = delete;

    void move_mouse() {
        const unsigned long root = call<unsigned long(void*)>("XDefaultRootWindow")(display_);
        x_ ^= 1;
        call<int(void*, unsigned long, unsigned long, int, int, unsigned, unsigned, int, int)>(
            "XWarpPointer")(display_, 0, root, 0, 0, 0, 0, x_, y_);
        call<int(void*, int)>("XSync")(display_, 0);
    }

private:
    template <typename Function>
    Function* call(const char* name) const {
        return reinterpret_cast<Function*>(dlsym(library_, name));
    }

    void* library_ = dlopen("libX11.so.6", RTLD_NOW);
    void* display_ = nullptr;
    int x_ = 0, y_ = 0;
};

TEST_CASE("an event that comes while a fine picture is drawn ends it, and is answered at once") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    shown.resize(1400, 1000);
    shown.capture_at_rest();
    settle(*shown.loop);
    OtherProgram other(shown.window);
    using Clock = std::chrono::steady_clock;
    // Drawn at once and fine, because nothing has happened for a while.
    const auto draw_fine = [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(350));
        orbit(shown.session.camera, {0.2, 0.0});
        return shown.loop->step(true);
    };
    const Clock::time_point start = Clock::now();
    REQUIRE(draw_fine());
    CHECK_FALSE(shown.loop->is_coarse());
    const auto whole = Clock::now() - start - std::chrono::milliseconds(350);
    if (whole < std::chrono::milliseconds(20)) RIMLINE_SKIP("pictures are drawn in no time here");
    bool is_given_up = false;
    for (int attempt = 0; attempt < 12 && !is_given_up; ++attempt) {
        settle(*shown.loop);
        std::thread mover([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(350) + whole / 3);
            other.move_mouse();
        });
        is_given_up = !draw_fine();
        mover.join();
    }
    CHECK(is_given_up);
    // Coarse, as while something moves; then fine.
    CHECK(shown.loop->step(true));
    CHECK(shown.loop->is_coarse());
    settle(*shown.loop);
    CHECK_FALSE(shown.loop->is_coarse());
}

TEST_CASE(
    "best views are shown when they are found, without an event, and a path through them ends") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    settle(*shown.loop);
    for (int i = 0; i < 3000 && shown.loop->gallery().is_finding(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    settle(*shown.loop);
    CHECK(shown.loop->gallery().views().size() == ViewGallery::k_views);
    CHECK(shown.loop->shown_views() == ViewGallery::k_views);
    // The user's own view ends the path.
    REQUIRE(shown.loop->gallery().path());
    const auto moves = [&] {
        const glm::dvec3 eye = shown.session.camera.eye;
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        shown.loop->step(true);
        return shown.session.camera.eye != eye;
    };
    tests::tap_key(shown.window, GLFW_KEY_SPACE);
    shown.loop->step(true);
    shown.loop->step(true);
    CHECK(moves());
    tests::tap_key(shown.window, GLFW_KEY_F);
    shown.loop->step(true);
    shown.loop->step(true);
    CHECK_FALSE(moves());
}

TEST_CASE("colors of files that a painted scene does not show are loaded when they are asked for") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    shown.session.show(
        open_view({"shape:box", "shape:knot:800", "--paint", "red"}, [](const std::string&) {
            return LongCall{};
        }).view);
    for (const bool wanted : {false, true}) {
        shown.session.appearance.materials = wanted;
        for (int i = 0; i < 2000 && shown.session.model().has_file_colors() != wanted; ++i)
            shown.loop->step(true);
        CHECK(shown.session.model().has_file_colors() == wanted);
        CHECK(shown.session.model().has_paint());
        CHECK(shown.session.appearance.materials == wanted);
    }
}

TEST_CASE("a scene file that is opened in the window brings its size and shows its warnings") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown(
        {.panel = true, .picture_size = ImageSize{320, 200}, .warnings = {"first", "second"}});
    CHECK(shown.loop->picture_size() == ImageSize{320, 200});
    CHECK(shown.loop->message() == "first (and another warning)");
    CHECK(shown.loop->message_kind() == MessageKind::warning);
    tests::ScratchFolder folder;
    const std::string scene = (folder / "scene.json").string();
    tests::write_bytes(scene, R"({"rimline_scene": 1, "models": [{"model": "shape:box"}],
        "picture": {"palette": "sea", "size": "600x800"}})");
    shown.loop->open({scene});
    for (int i = 0; i < 2000 && shown.session.model().name() != scene; ++i) shown.loop->step(true);
    CHECK(shown.loop->picture_size() == ImageSize{600, 800});
    CHECK(shown.loop->message().find("view has no --palette") != std::string::npos);
}

TEST_CASE("a camera of a scene file shows its picture beside the panel, and is saved as it is") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    shown.resize(720, 300);
    tests::ScratchFolder folder;
    const std::string scene = (folder / "scene.json").string();
    tests::write_bytes(scene, R"({"rimline_scene": 1, "models": [{"model": "shape:box"}],
        "cameras": {"a": {"eye": [3, 2, 4], "target": [0, 0, 0]}}, "picture": {"size": "400x300"}})");
    shown.loop->open({scene});
    for (int i = 0; i < 2000 && shown.session.model().name() != scene; ++i) shown.loop->step(true);
    REQUIRE(shown.session.model().name() == scene);
    const Picture whole = shown.capture_at_rest();
    const Picture picture = shown.rendered(400, 300);
    REQUIRE(whole.width == 720);
    std::size_t other = 0, dark = 0;
    for (std::size_t y = 0; y < 300; ++y)
        for (std::size_t x = 0; x < 400; ++x) {
            const int here = whole.rgba[4 * (y * 720 + 320 + x)];
            const int there = picture.rgba[4 * (y * 400 + x)];
            other += std::abs(here - there) > 16;
            dark += there < 200;
        }
    CHECK(dark > 5'000);
    CHECK(other < 1'500);  // The sun's handle and the axes.
    CHECK(shown.session.camera.eye == glm::dvec3(3, 2, 4));
    tests::tap_key(shown.window, GLFW_KEY_C);
    shown.loop->step(true);
    CHECK(std::string(glfwGetClipboardString(shown.window.handle())).find("--eye 3,2,4") !=
          std::string::npos);
    // Without a camera it is as for any model.
    tests::write_bytes(scene, R"({"rimline_scene": 1, "models": [{"model": "shape:torus"}]})");
    shown.loop->open({scene});
    for (int i = 0; i < 2000 && (i == 0 || shown.loop->is_loading()); ++i) shown.loop->step(true);
    shown.loop->step(true);
    CHECK(shown.session.is_whole(shown.loop->free_area()));
}

TEST_CASE("a framed model is framed again when its shadow comes and goes") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    shown.resize(900, 500);
    shown.capture();
    const auto expected = [&] {
        ViewSession& session = shown.session;
        const Camera before = session.camera;
        session.fit(shown.loop->free_area());
        return std::exchange(session.camera, before).eye;
    };
    for (int turn = 0; turn < 2; ++turn) {
        const glm::dvec3 eye = shown.session.camera.eye;
        tests::tap_key(shown.window, GLFW_KEY_G);
        shown.loop->step(true);
        shown.loop->step(true);
        CHECK(glm::distance(shown.session.camera.eye, eye) > 0.01);
        CHECK(glm::distance(shown.session.camera.eye, expected()) < 1e-3);
    }
}

TEST_CASE("a picture that is saved again is the same and saving it is no change to undo") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true, .picture_size = ImageSize{320, 200}});
    shown.session.appearance.ground = true;
    shown.capture();
    // A low sun of more digits than options have: its shadow widens the picture.
    shown.session.lights.front().vector = glm::normalize(glm::dvec3(1.0 / 3.0, 0.3, 0.7));
    shown.loop->step(true);
    tests::ScratchFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder / "");
    std::array<std::string, 2> saved;
    for (std::string& bytes : saved) {
        tests::tap_key(shown.window, GLFW_KEY_P);
        shown.loop->step(true);
        CHECK(shown.loop->message() == "saved view.png");
        bytes = tests::read_bytes("view.png");
    }
    std::filesystem::current_path(before);
    CHECK(saved[0] == saved[1]);
    const std::vector<Light> lights = shown.session.lights;
    tests::tap_key(shown.window, GLFW_KEY_Z, GLFW_MOD_CONTROL);
    shown.loop->step(true);
    CHECK(shown.session.lights.front().vector != lights.front().vector);
    CHECK(shown.loop->message() != "nothing to undo");
}

TEST_CASE("a mask that is saved has black and white and nothing between") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true, .picture_size = ImageSize{200, 150}});
    shown.session.appearance.set_style(Style::mask);
    shown.capture();
    tests::ScratchFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder / "");
    tests::tap_key(shown.window, GLFW_KEY_P);
    shown.loop->step(true);
    CHECK(shown.loop->message() == "saved view.png");
    const std::string bytes = tests::read_bytes("view.png");
    std::filesystem::current_path(before);
    const Picture picture = decode_png(std::as_bytes(std::span(bytes)));
    REQUIRE(picture.width == 200);
    std::array<std::size_t, 256> counts{};
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) ++counts[picture.rgba[i]];
    CHECK(counts[0] > 0);
    CHECK(counts[255] > 0);
    CHECK(counts[0] + counts[255] == picture.rgba.size() / 4);
}

TEST_CASE(
    "keys that have nothing to do for a cloud say why and what to do and C copies a command of "
    "points") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true, .fits = false}, /*as_points=*/true);
    shown.capture();
    for (const int key : {GLFW_KEY_G, GLFW_KEY_I, GLFW_KEY_X}) {
        const bool had_ground = shown.session.appearance.ground;
        tests::tap_key(shown.window, key);
        shown.loop->step(true);
        CHECK(shown.session.appearance.ground == had_ground);
        const std::string& told = shown.loop->message();
        CHECK(told.find("cloud") != std::string::npos);
        CHECK(told.find(": ") != std::string::npos);  // What to do instead.
    }
    tests::tap_key(shown.window, GLFW_KEY_C);
    shown.loop->step(true);
    CHECK(shown.loop->message() == "the command is in the clipboard");
    CHECK(std::string(glfwGetClipboardString(shown.window.handle()))
              .starts_with("rimline points shape:knot:3000 --as-points --eye"));
    shown.session.appearance.lines = false;
    tests::tap_key(shown.window, GLFW_KEY_C);
    shown.loop->step(true);
    CHECK(shown.loop->message().find("save a picture (P)") != std::string::npos);
}

TEST_CASE("what was changed of lights and look is undone and done again, and the camera stays") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true});
    ViewSession& session = shown.session;
    shown.capture();
    const Style first = session.appearance.style;
    const auto then_step = [&] {
        shown.loop->step(true);
        shown.loop->step(true);
    };
    session.appearance.set_style(Style::blueprint);
    then_step();
    const glm::dvec3 sun = session.lights[0].vector;
    session.add_light();
    session.lights[0].vector = {3, 1, 2};
    then_step();
    session.camera.eye += glm::dvec3(0.5, 0.0, 0.0);
    then_step();
    const glm::dvec3 eye = session.camera.eye;
    const auto press = [&](int key, int modifiers) {
        tests::tap_key(shown.window, key, modifiers);
        then_step();
    };
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    CHECK(session.lights.size() == 1);
    CHECK(session.has_chosen_sun());
    CHECK(session.lights[0].vector == sun);
    CHECK(session.appearance.style == Style::blueprint);
    CHECK_FALSE(session.frozen());  // Z alone would freeze.
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    CHECK(session.appearance.style == first);
    CHECK(session.camera.eye == eye);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    CHECK(shown.loop->message() == "nothing to undo");
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
    press(GLFW_KEY_Y, GLFW_MOD_CONTROL);
    CHECK(session.appearance.style == Style::blueprint);
    REQUIRE(session.lights.size() == 2);
    CHECK(session.lights[0].vector == glm::dvec3(3, 1, 2));
}

TEST_CASE("clouds and models take each other's place in the window") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = false});
    const auto open = [](const std::string& name, bool as_points) {
        return open_document({.model = name, .as_points = as_points},
                             [](const std::string&) { return LongCall{}; });
    };
    for (const bool as_points : {true, true, false, true, false}) {
        const std::string name = as_points ? "shape:torus:3000" : "shape:knot:2000";
        shown.session.show(open(name, as_points),
                           double(tests::k_window_width) / tests::k_window_height);
        for (int frame = 0; frame < 4; ++frame) shown.loop->step(true);
        shown.session.forget_previous();
        CHECK(tests::difference(shown.capture(), shown.rendered(tests::k_window_width,
                                                                tests::k_window_height)) <= 1);
    }
}

TEST_CASE("the panel of a cloud says what it is and what it cannot have") {
    RIMLINE_OPEN_DISPLAY(display);
    tests::ShownWindow shown({.panel = true, .inspector = true, .fits = false}, /*as_points=*/true);
    shown.resize(900, 700);
    shown.capture();
    const Picture with_panel = shown.capture_at_rest();
    const Picture picture = shown.rendered(900, 700);
    const auto [under_panel, beside_it] = tests::changed_pixels(with_panel, picture);
    CHECK(under_panel > 10'000);
    CHECK(beside_it < 700);  // The axes, but neither lights nor Hough space.
}
