// Where the session moves its camera so that the document is in the free area of the window.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <utility>

#include "tests/tools/view/opened_model.h"
#include "tools/view/camera_motion.h"
#include "tools/view/screen_view.h"
#include "tools/view/view_arguments.h"
#include "tools/view/view_session.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("between panels the model is whole in the middle of what they leave from every side" *
          doctest::test_suite("plain")) {
    ViewSession session;
    for (const char* name : {"shape:spring", "shape:scene", "shape:knot"}) {
        session.show(tests::opened_model(name), 1.2);
        for (const FreeArea& area : {FreeArea{.window = {1280, 860}, .left = 320},
                                     FreeArea{.window = {900, 700}, .left = 320, .right = 290},
                                     FreeArea{.window = {700, 900}, .left = 0, .right = 300}})
            for (const bool orthographic : {false, true}) {
                session.appearance.orthographic = orthographic;
                session.apply_lens();
                orbit(session.camera, {0.7, 0.2});
                session.fit(area);
                const ScreenView view(session.camera, area.window);
                double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
                for (const glm::vec3& p : session.model().mesh().positions()) {
                    const auto pixel = view.pixel_of(glm::dvec3(p));
                    REQUIRE(pixel);
                    left = std::min(left, pixel->x), right = std::max(right, pixel->x);
                    top = std::min(top, pixel->y), bottom = std::max(bottom, pixel->y);
                }
                CAPTURE(name);
                CAPTURE(area.right);
                CHECK(left > area.left);
                CHECK(right < area.window.x - area.right);
                CHECK(top > 0.0);
                CHECK(bottom < area.window.y);
                // It fills one of the two directions.
                CHECK(std::max((right - left) / area.width(), (bottom - top) / area.window.y) >
                      0.75);
                CHECK(0.5 * (left + right) ==
                      doctest::Approx(area.left + 0.5 * area.width()).epsilon(0.03));
            }
    }
}

TEST_CASE(
    "a fitted model that is orbited stays whole, steps back where it must and never comes nearer") {
    ViewSession session;
    // A long one, which is small from its end.
    session.show(open_view({"shape:box", "shape:box", "--at", "9,0,0"}, [](const std::string&) {
                     return LongCall{};
                 }).view);
    for (const bool orthographic : {false, true})
        for (const FreeArea& area : {FreeArea{.window = {1280, 860}, .left = 320},
                                     FreeArea{.window = {900, 700}, .left = 320, .right = 290}}) {
            session.appearance.orthographic = orthographic;
            session.apply_lens();
            session.look_from({1, 0.2, 0});
            session.fit(area);
            double height = view_height(session.camera);
            const double first = height;
            bool was_whole = true;
            Camera turned = session.camera;
            for (int turn = 0; turn < 60; ++turn) {
                orbit_about(turned, session.bounds().center, {0.05, 0.0});
                orbit_about(session.camera, session.bounds().center, {0.05, 0.0});
                session.keep_whole(area);
                CHECK(session.is_whole(area));
                // Little by little.
                const double now = view_height(session.camera);
                CHECK(now >= height * (1.0 - 1e-9));
                CHECK(now < 1.5 * height);
                height = now;
                const Camera kept = std::exchange(session.camera, turned);
                was_whole = was_whole && session.is_whole(area);
                session.camera = kept;
            }
            CHECK(height > 1.3 * first);
            CHECK_FALSE(was_whole);  // It would not be without that.
        }
    // One turn at once, after which the eye would be within it.
    session.appearance.orthographic = false;
    session.appearance.fov_y_deg = 110.0;
    session.apply_lens();
    session.look_from({0, 0.1, 1});
    const FreeArea area{.window = {1280, 860}, .left = 320};
    session.fit(area);
    orbit_about(session.camera, session.bounds().center, {1.57, 0.0});
    const ScreenView view(session.camera, area.window);
    REQUIRE_FALSE(std::ranges::all_of(session.model().mesh().positions(), [&](const glm::vec3& p) {
        return view.pixel_of(glm::dvec3(p)).has_value();
    }));
    session.keep_whole(area);
    CHECK(session.is_whole(area));
}

TEST_CASE("what is in the middle between panels is as far as the target") {
    ViewSession session;
    session.show(tests::opened_model("shape:knot"), 1.2);
    const FreeArea area{.window = {1000, 700}, .left = 320, .right = 80};
    for (const bool orthographic : {false, true}) {
        session.appearance.orthographic = orthographic;
        session.apply_lens();
        orbit(session.camera, {0.4, 0.3});
        const glm::dvec3 middle = session.middle_of(area);
        const auto pixel = ScreenView(session.camera, area.window).pixel_of(middle);
        REQUIRE(pixel);
        CHECK(glm::distance(*pixel, glm::dvec2(620, 350)) < 1e-6);
        const glm::dvec3 ahead = session.camera.target - session.camera.eye;
        CHECK(std::abs(glm::dot(middle - session.camera.target, ahead)) < 1e-9);
    }
    CHECK(session.middle_of({.window = {1000, 700}}) == session.camera.target);
}

TEST_CASE("with a ground the model is whole too beside its shadow" * doctest::test_suite("plain")) {
    ViewSession session;
    session.appearance.ground = true;
    for (const char* name : {"shape:spring", "shape:knot"})
        for (const FreeArea& area : {FreeArea{.window = {1100, 850}, .left = 320},
                                     FreeArea{.window = {900, 700}, .left = 320, .right = 290}}) {
            session.show(tests::opened_model(name), area.aspect());
            for (int turn = 0; turn < 8; ++turn) {
                orbit(session.camera, {0.8, turn < 4 ? 0.1 : -0.1});
                session.fit(area);
                CAPTURE(name);
                CAPTURE(turn);
                CHECK(session.is_whole(area));
            }
        }
}

TEST_CASE(
    "a picture that is given is whole beside the panels, from the same eye, until it is fitted") {
    constexpr double k_aspect = 1.5;
    const auto corner_of = [](const Camera& camera, int corner) {
        const glm::dvec2 size(k_aspect, 1.0);
        const Ray ray =
            ScreenView(camera, size).ray_through(glm::dvec2(corner % 2, corner / 2) * size);
        return ray.origin + glm::distance(camera.eye, camera.target) * ray.direction;
    };
    for (const char* lens : {"--fov=50", "--ortho=5"}) {
        ViewSession session;
        session.show(open_view({"shape:knot", "--eye=3,2,4", lens, "--size=600x400"},
                               [](const std::string&) { return LongCall{}; })
                         .view);
        const Camera given = session.camera;
        const std::string command = session.command({600, 400}, "a.png");
        CHECK(session.shown_camera({.window = {600, 400}}) == given);
        CHECK(session.shown_camera({.window = {0, 0}}) == given);  // Minimized.
        for (const FreeArea& area : {FreeArea{.window = {1280, 860}, .left = 320},
                                     FreeArea{.window = {1600, 500}, .left = 320},
                                     FreeArea{.window = {900, 700}, .left = 320, .right = 290},
                                     FreeArea{.window = {300, 700}}}) {
            CAPTURE(lens);
            CAPTURE(area.window.x);
            const Camera shown = session.shown_camera(area);
            CHECK(shown.eye == given.eye);
            CHECK(shown.target == given.target);
            const ScreenView view(shown, area.window);
            const auto low = view.pixel_of(corner_of(given, 0));
            const auto high = view.pixel_of(corner_of(given, 3));
            REQUIRE(low);
            REQUIRE(high);
            CHECK(low->x >= area.left - 1e-6);
            CHECK(high->x <= area.left + area.width() + 1e-6);
            CHECK(low->y >= -1e-6);
            CHECK(high->y <= area.window.y + 1e-6);
            // As large as there is room for, and in the middle.
            CHECK(std::max((high->x - low->x) / area.width(), (high->y - low->y) / area.window.y) ==
                  doctest::Approx(1.0));
            const glm::dvec2 middle(area.left + 0.5 * area.width(), 0.5 * area.window.y);
            CHECK(glm::distance(0.5 * (*low + *high), middle) < 1e-6);
            CHECK(glm::distance(*view.pixel_of(session.middle_of(area)), middle) < 1e-6);
            CHECK(session.is_whole(area));
        }
        CHECK(session.command({600, 400}, "a.png") == command);
        const FreeArea area{.window = {1280, 860}, .left = 320};
        session.fit(area);
        CHECK(session.shown_camera(area) == session.camera);
        CHECK(session.is_whole(area));
    }
}
