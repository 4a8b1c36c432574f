#include "tools/view/light_handles.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <random>

using namespace rimline;
using namespace rimline::tools;

namespace {

constexpr glm::dvec2 k_light_handles_size(900.0, 600.0);
const SceneBounds k_model{.center = {0.3, -0.2, 0.1}, .radius = 1.7};

Camera some_camera(double ortho_height) {
    return {.eye = {4, 3, 9},
            .target = {0.3, 0, 0},
            .up = {0, 1, 0},
            .fov_y_deg = 40.0,
            .ortho_height = ortho_height};
}

}  // namespace

TEST_CASE("a light that is dragged is seen under the mouse") {
    const unsigned seed = 3;
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const double ortho_height : {0.0, 6.0}) {
        const ScreenView view(some_camera(ortho_height), k_light_handles_size);
        const glm::dvec2 middle = *view.pixel_of(k_model.center);
        for (int i = 0; i < 200; ++i) {
            Light light{.vector = {unit(random), unit(random), unit(random)},
                        .directional = i % 2 == 0};
            if (glm::length(light.vector) < 0.1) continue;
            // Well inside the sphere's outline.
            const glm::dvec2 mouse = middle + 80.0 * glm::dvec2(unit(random), unit(random));
            drag_light(light, k_model, view, mouse);
            const auto handle = view.pixel_of(light_handle(light, k_model));
            REQUIRE(handle);
            CHECK(glm::distance(*handle, mouse) < 1e-6);
        }
    }
}

TEST_CASE("a sun that is dragged stays on its side of the model, and a lamp at its distance") {
    const ScreenView view(some_camera(0.0), k_light_handles_size);
    const glm::dvec3 ahead = view.view_direction();
    const glm::dvec2 middle = *view.pixel_of(k_model.center);
    for (const double side : {-1.0, 1.0}) {
        Light sun{.vector = side * ahead, .directional = true};
        drag_light(sun, k_model, view, middle + glm::dvec2(40, 25));
        CHECK(glm::dot(sun.vector, ahead) * side > 0.5);
        CHECK(glm::length(sun.vector) == doctest::Approx(1.0));
    }
    Light lamp{.vector = {1, 2, 3}, .directional = false};
    const double depth = glm::dot(lamp.vector, ahead);
    drag_light(lamp, k_model, view, {100, 500});
    CHECK(glm::dot(lamp.vector, ahead) == doctest::Approx(depth));
}

TEST_CASE("beyond its sphere a sun goes to the outline, towards the mouse") {
    const ScreenView view(some_camera(6.0), k_light_handles_size);
    const glm::dvec2 middle = *view.pixel_of(k_model.center);
    Light sun{.vector = {0, 0, 1}, .directional = true};
    drag_light(sun, k_model, view, middle + glm::dvec2(440, 0));
    CHECK(std::abs(glm::dot(sun.vector, view.view_direction())) < 1e-9);
    const glm::dvec2 at = *view.pixel_of(light_handle(sun, k_model));
    CHECK(at.x > middle.x + 100.0);
    CHECK(at.y == doctest::Approx(middle.y));
}

TEST_CASE("the wheel pushes lamps along the line of sight and suns through the model") {
    const ScreenView view(some_camera(0.0), k_light_handles_size);
    Light lamp{.vector = {1, 1, 1}, .directional = false};
    const glm::dvec2 at = *view.pixel_of(lamp.vector);
    const double before = glm::distance(lamp.vector, view.camera().eye);
    push_light(lamp, k_model, view, 1.25);
    CHECK(glm::distance(lamp.vector, view.camera().eye) == doctest::Approx(1.25 * before));
    CHECK(glm::distance(*view.pixel_of(lamp.vector), at) < 1e-9);

    Light sun{.vector = glm::normalize(glm::dvec3(0.2, 0.3, 1.0)), .directional = true};
    const Light near = sun;
    push_light(sun, k_model, view, 0.9);
    CHECK(glm::distance(sun.vector, near.vector) < 1e-12);
    push_light(sun, k_model, view, 1.1);
    CHECK(glm::dot(light_handle(sun, k_model) - k_model.center, view.view_direction()) > 0.0);
}

TEST_CASE("a lamp goes no farther than coordinates reach, however far it is pushed or dragged") {
    for (const double ortho_height : {0.0, 6.0})
        for (const double radius : {1.7, 0x1p57}) {
            const SceneBounds model{.center = {0.3, -0.2, 0.1}, .radius = radius};
            Camera camera = some_camera(ortho_height);
            camera.eye *= radius;
            const ScreenView view(camera, k_light_handles_size);
            Light lamp{.vector = radius * glm::dvec3(1, 2, -1), .directional = false};
            for (int i = 0; i < 3000; ++i) push_light(lamp, model, view, 1.06);
            const double pushed = glm::distance(lamp.vector, model.center);
            CHECK(pushed <= 1.0001 * k_max_lamp_radii * radius);
            CHECK(pushed > 3.0 * radius);
            CHECK(HomogeneousPoint::is_valid(glm::vec3(lamp.vector)));
            drag_light(lamp, model, view, {1e7, 1e7});
            CHECK(HomogeneousPoint::is_valid(glm::vec3(lamp.vector)));
        }
}

TEST_CASE("a handle outside of the window is shown at its edge") {
    const ScreenView view(some_camera(0.0), k_light_handles_size);
    const glm::dvec2 low(20.0), high = k_light_handles_size - 20.0;
    const Light far_away{.vector = {100, 0, -40}, .directional = false};
    const ShownHandle shown = shown_handle(far_away, k_model, view, low, high);
    CHECK(shown.is_outside());
    CHECK(shown.pixel.x == high.x);
    CHECK(shown.outwards.x > 0.0);
    const Light near_by{.vector = {0.3, 0, 0}, .directional = false};
    const ShownHandle inside = shown_handle(near_by, k_model, view, low, high);
    CHECK_FALSE(inside.is_outside());
    CHECK(inside.pixel == *view.pixel_of(near_by.vector));
    Light behind{.vector = {4, 30, 20}, .directional = false};
    const ShownHandle above = shown_handle(behind, k_model, view, low, high);
    CHECK(above.is_outside());
    CHECK(above.pixel.y == low.y);
    // It can be fetched.
    drag_light(behind, k_model, view, above.pixel);
    REQUIRE(view.pixel_of(behind.vector));
    CHECK(glm::distance(*view.pixel_of(behind.vector), above.pixel) < 1e-6);
}

TEST_CASE("a sun becomes a lamp on the same side, and a lamp a sun from there") {
    const Light sun{.vector = glm::normalize(glm::dvec3(1, 2, -1)), .directional = true};
    const Light lamp = as_lamp(sun, k_model);
    CHECK_FALSE(lamp.directional);
    const Light again = as_sun(lamp, k_model);
    CHECK(again.directional);
    CHECK(glm::distance(again.vector, sun.vector) < 1e-12);
    // Where it has no direction, any will do, but one there is.
    CHECK(glm::length(as_sun({.vector = k_model.center, .directional = false}, k_model).vector) ==
          doctest::Approx(1.0));
}
