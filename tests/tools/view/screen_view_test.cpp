#include "tools/view/screen_view.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <random>

using namespace rimline;
using namespace rimline::tools;

namespace {

constexpr glm::dvec2 k_screen_view_size(800.0, 500.0);

// As the engine projects: its own axes and projection, then the viewport.
glm::dvec2 pixel_by_engine(const Camera& camera, const glm::dvec3& world) {
    const glm::dvec3 eye = camera_from_world(camera) * (world - camera.eye);
    const Projection p =
        make_projection(camera, k_screen_view_size.x / k_screen_view_size.y, glm::dvec3(0.0), 10.0);
    const double w = p.w[0] * eye.z + p.w[1];
    const glm::dvec2 ndc = p.scale * glm::dvec2(eye) / w + p.shift;
    return (0.5 * ndc + 0.5) * k_screen_view_size;
}

}  // namespace

TEST_CASE("pixels are where the engine draws, and rays go back through them") {
    const unsigned seed = 5;
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-2.0, 2.0);
    for (const double ortho_height : {0.0, 4.0}) {
        Camera camera{.eye = {3, 2, 7},
                      .target = {0.2, -0.1, 0},
                      .up = {0, 1, 0},
                      .fov_y_deg = 50.0,
                      .ortho_height = ortho_height};
        for (int i = 0; i < 200; ++i) {
            if (i == 100) {  // Off its axis from here on.
                camera.projection = make_projection(camera, 1.4, glm::dvec3(0.0), 10.0);
                camera.projection->shift = {0.3, -0.2};
            }
            const ScreenView view(camera, k_screen_view_size);
            const glm::dvec3 world(place(random), place(random), place(random));
            const auto pixel = view.pixel_of(world);
            REQUIRE(pixel);
            CHECK(glm::distance(*pixel, pixel_by_engine(camera, world)) < 1e-6);
            const Ray ray = view.ray_through(*pixel);
            CHECK(glm::length(ray.direction) == doctest::Approx(1.0));
            const glm::dvec3 from = world - ray.origin;
            CHECK(glm::length(glm::cross(from, ray.direction)) < 1e-9);
            CHECK(glm::dot(from, ray.direction) > 0.0);
        }
    }
}

TEST_CASE("what is not in front of a perspective eye is at no pixel") {
    const ScreenView view({.eye = {0, 0, 5}, .target = {0, 0, 0}}, k_screen_view_size);
    CHECK_FALSE(view.pixel_of({0, 0, 6}));
    CHECK_FALSE(view.pixel_of({1, 0, 5}));
    CHECK_FALSE(view.pixel_of({0, 0, 5}));
    CHECK(view.pixel_of({0, 0, 4.9}));
}
