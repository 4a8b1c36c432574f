#include "tools/view/camera_motion.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "tools/view/screen_view.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

constexpr glm::dvec2 k_camera_motion_size(1000.0, 700.0);

Camera some_camera() {
    return {.eye = {1.0, 2.0, 6.0}, .target = {0.5, 0.2, -0.3}, .up = {0, 1, 0}, .fov_y_deg = 35.0};
}

double elevation_deg(const Camera& camera) {
    return glm::degrees(std::asin(glm::dot(glm::normalize(camera.eye - camera.target), camera.up)));
}

bool near(const glm::dvec3& a, const glm::dvec3& b, double by = 1e-9) {
    return glm::distance(a, b) <= by;
}

}  // namespace

TEST_CASE("orbiting keeps target and distance, turns around up by what is asked, and comes back") {
    Camera camera = some_camera();
    const Camera before = camera;
    const double distance = glm::distance(camera.eye, camera.target);
    orbit(camera, {0.7, 0.0});
    CHECK(near(camera.target, before.target));
    CHECK(glm::distance(camera.eye, camera.target) == doctest::Approx(distance));
    const glm::dvec3 a = before.eye - before.target;
    const glm::dvec3 b = camera.eye - camera.target;
    CHECK(b.y == doctest::Approx(a.y));
    // Counter-clockwise from above: from +z towards +x.
    CHECK(std::atan2(b.x, b.z) - std::atan2(a.x, a.z) == doctest::Approx(0.7));
    orbit(camera, {-0.7, 0.0});
    CHECK(near(camera.eye, before.eye));
    orbit(camera, {0.0, 0.2});
    CHECK(elevation_deg(camera) == doctest::Approx(elevation_deg(before) + glm::degrees(0.2)));
}

TEST_CASE("no orbit and no glance passes a pole, whatever is up") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> turn(-2.0, 2.0);
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)}) {
        Camera camera = some_camera();
        const double distance = glm::distance(camera.eye, camera.target);
        set_up(camera, up);
        for (int i = 0; i < 500; ++i) {
            const glm::dvec2 by(turn(random), turn(random));
            if (i % 2 == 0)
                orbit(camera, by);
            else
                turn_view(camera, by);
            CHECK(std::abs(elevation_deg(camera)) <= k_max_elevation_deg + 1e-6);
            CHECK(glm::distance(camera.eye, camera.target) == doctest::Approx(distance));
        }
    }
}

TEST_CASE("a direction has the same place about another up axis") {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 2, 3));
    for (const glm::dvec3 up : {glm::dvec3(0, 0, 1), {0, -1, 0}, {1, 0, 0}}) {
        const glm::dvec3 there = direction_about(direction, {0, 2, 0}, up);
        CHECK(glm::length(there) == doctest::Approx(1.0));
        CHECK(glm::dot(there, up) == doctest::Approx(direction.y));
        CHECK(near(direction_about(there, up, {0, 1, 0}), direction));
    }
    CHECK(near(direction_about({0, 0, 1}, {0, 1, 0}, {0, 0, 1}), {0, -1, 0}));  // In front.
}

TEST_CASE("a view straight down can be orbited out of") {
    Camera camera{.eye = {0, 5, 0}, .target = {0, 0, 0}, .up = {0, 1, 0}};
    orbit(camera, {0.3, -0.5});
    CHECK(glm::distance(camera.eye, camera.target) == doctest::Approx(5.0));
    CHECK(elevation_deg(camera) == doctest::Approx(90.0 - glm::degrees(0.5)).epsilon(0.02));
}

TEST_CASE("panning carries what lies at the target's distance along with the mouse") {
    for (const double ortho_height : {0.0, 3.0}) {
        Camera camera = some_camera();
        camera.ortho_height = ortho_height;
        const glm::dvec3 seen = camera.target;
        const glm::dvec2 from = *ScreenView(camera, k_camera_motion_size).pixel_of(seen);
        pan(camera, glm::dvec2(120.0, -45.0) / k_camera_motion_size.y);
        const glm::dvec2 to = *ScreenView(camera, k_camera_motion_size).pixel_of(seen);
        CHECK(to.x - from.x == doctest::Approx(120.0));
        CHECK(to.y - from.y == doctest::Approx(45.0));  // Pixels count downwards.
    }
}

TEST_CASE(
    "a camera that orbits about a point keeps it in its place, and turns as it would about its "
    "target") {
    Camera camera{.eye = {3, 2, 4}, .target = {0.5, 0.2, -0.1}, .up = {0, 1, 0}};
    const glm::dvec3 pivot(-0.7, 0.4, 0.3);
    Camera other = camera;
    const glm::dvec3 place = camera_from_world(camera) * (pivot - camera.eye);
    for (const glm::dvec2& turn_rad : {glm::dvec2(0.3, 0.1), {-1.2, -0.4}, {0.0, 3.0}}) {
        orbit_about(camera, pivot, turn_rad);
        orbit(other, turn_rad);
        CHECK(glm::distance(camera_from_world(camera) * (pivot - camera.eye), place) < 1e-9);
        CHECK(glm::distance(camera.eye - camera.target, other.eye - other.target) < 1e-9);
    }
}

TEST_CASE(
    "a camera turned about a point looks from where it is told to, and keeps the point in its "
    "place") {
    Camera camera{.eye = {3, 2, 4}, .target = {0.5, 0.2, -0.1}, .up = {0, 1, 0}};
    const glm::dvec3 pivot(-0.7, 0.4, 0.3);
    const glm::dvec3 place = camera_from_world(camera) * (pivot - camera.eye);
    const double distance = glm::distance(camera.eye, camera.target);
    for (const glm::dvec3& from : {glm::dvec3(1, 0.2, 0), {-0.3, -2, 0.4}, {0, 0, -1}}) {
        turn_about(camera, pivot, from);
        CHECK(glm::distance(glm::normalize(camera.eye - camera.target), glm::normalize(from)) <
              1e-9);
        CHECK(glm::distance(camera.eye, camera.target) == doctest::Approx(distance));
        CHECK(glm::distance(camera_from_world(camera) * (pivot - camera.eye), place) < 1e-9);
    }
}

TEST_CASE("zooming scales distance or height, within its limits") {
    Camera camera = some_camera();
    const double distance = glm::distance(camera.eye, camera.target);
    zoom(camera, 0.5, 0.1, 100.0);
    CHECK(glm::distance(camera.eye, camera.target) == doctest::Approx(0.5 * distance));
    for (int i = 0; i < 100; ++i) zoom(camera, 0.5, 0.1, 100.0);
    CHECK(glm::distance(camera.eye, camera.target) == doctest::Approx(0.1));
    for (int i = 0; i < 100; ++i) zoom(camera, 2.0, 0.1, 100.0);
    CHECK(glm::distance(camera.eye, camera.target) == doctest::Approx(100.0));
    camera.ortho_height = 2.0;
    zoom(camera, 0.25, 0.1, 100.0);
    CHECK(camera.ortho_height == doctest::Approx(0.5));
    CHECK(glm::distance(camera.eye, camera.target) == doctest::Approx(100.0));
}

TEST_CASE("looking around keeps the eye and to the right is to the right on the screen") {
    Camera camera = some_camera();
    const Camera before = camera;
    turn_view(camera, {0.1, 0.0});
    CHECK(near(camera.eye, before.eye));
    // What was in the middle is left of it now.
    CHECK(ScreenView(camera, k_camera_motion_size).pixel_of(before.target)->x <
          0.5 * k_camera_motion_size.x);
    turn_view(camera, {0.0, 0.1});
    CHECK(ScreenView(camera, k_camera_motion_size).pixel_of(before.target)->y >
          0.5 * k_camera_motion_size.y);
}

TEST_CASE("flying moves eye and target alike: right, up, and ahead") {
    const Camera before = some_camera();
    const glm::dvec3 ahead = glm::normalize(before.target - before.eye);
    Camera camera = before;
    fly(camera, {0.0, 0.0, 1.5});
    CHECK(near(camera.eye, before.eye + 1.5 * ahead));
    CHECK(near(camera.target, before.target + 1.5 * ahead));
    camera = before;
    fly(camera, {0.0, 2.0, 0.0});
    CHECK(near(camera.eye, before.eye + glm::dvec3(0, 2, 0)));
    camera = before;
    fly(camera, {1.0, 0.0, 0.0});
    CHECK(glm::dot(camera.eye - before.eye, ahead) == doctest::Approx(0.0));
    CHECK(ScreenView(camera, k_camera_motion_size).pixel_of(before.target)->x <
          0.5 * k_camera_motion_size.x);
}
