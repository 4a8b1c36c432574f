#include "engine/frame/scene_check.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "engine/renderer_options.h"
#include "engine/scene.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/stops.h"

namespace rimline {
namespace {

using tests::stops;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr float k_infinity = std::numeric_limits<float>::infinity();

TEST_CASE("numbers of a scene outside of their limits stop the program") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const HoughOctree octree(mesh);
    Scene right;
    right.instances.push_back({.octree = &octree});
    right.lights.push_back({.vector = {0, 1e-20, 0}});
    right.lights.push_back({.vector = {0, 0, 0}, .directional = false, .share = 0.5f});
    right.silhouette_camera = Camera{.eye = {1, 2, 3}, .ortho_height = 2.0};
    const auto stops_with = [&](const std::function<void(Scene&)>& change) {
        Scene scene = right;
        change(scene);
        return stops([&] { check_scene(scene); });
    };
    CHECK_FALSE(stops_with([](Scene&) {}));
    // As near to a rotation as single precision gives it.
    CHECK_FALSE(stops_with([](Scene& s) { s.instances[0].rotation[0][1] = 1e-7; }));

    CHECK(stops_with([](Scene& s) { s.instances[0].octree = nullptr; }));
    CHECK(stops_with([](Scene& s) { s.instances[0].rotation *= 2.0; }));
    CHECK(stops_with([](Scene& s) { s.instances[0].rotation[0] *= -1.0; }));
    CHECK(stops_with([](Scene& s) { s.instances[0].rotation[2][1] = k_nan; }));
    CHECK(stops_with([](Scene& s) { s.instances[0].translation.x = k_nan; }));
    CHECK(stops_with([](Scene& s) { s.instances[0].fade_radius = -1.0; }));
    CHECK(stops_with([](Scene& s) { s.lights[0].vector = glm::dvec3(0.0); }));
    CHECK(stops_with([](Scene& s) { s.lights[0].vector = {0, k_nan, 0}; }));
    CHECK(stops_with([](Scene& s) { s.lights[1].vector = {1e19, 0, 0}; }));
    CHECK(stops_with([](Scene& s) { s.lights[1].share = -0.5f; }));
    CHECK(stops_with([](Scene& s) { s.lights[1].share = 0.0f; }));
    CHECK(stops_with([](Scene& s) { s.camera.target = s.camera.eye; }));
    CHECK(stops_with([](Scene& s) { s.camera.eye.z = k_nan; }));
    CHECK(stops_with([](Scene& s) { s.camera.fov_y_deg = 180.0; }));
    CHECK(stops_with([](Scene& s) { s.camera.fov_y_deg = 0.0; }));
    CHECK(stops_with([](Scene& s) { s.camera.ortho_height = k_nan; }));
    CHECK(stops_with([](Scene& s) { s.silhouette_camera->target = s.silhouette_camera->eye; }));
    CHECK(stops_with([](Scene& s) { s.palette.grid_strength = 1.5f; }));
    CHECK(stops_with([](Scene& s) { s.hidden_line_strength = -0.1f; }));
    CHECK(stops_with([](Scene& s) { s.line_width_px = -1.0f; }));
    CHECK(stops_with([](Scene& s) { s.line_width_px = k_infinity; }));
    CHECK(stops_with([](Scene& s) { s.dash_gap_px = -1.0f; }));
    CHECK(stops_with([](Scene& s) { s.crease_angle_deg = -1.0f; }));
    CHECK(stops_with([](Scene& s) { s.hatch_spacing_px = 0.0f; }));
}

TEST_CASE("options of a renderer outside of their limits stop the program") {
    CHECK_FALSE(stops([] { checked({}); }));
    CHECK(stops([] { checked({.frames_in_flight = 0}); }));
    CHECK(stops([] { checked({.crease_angle_rad = -0.1f}); }));
    CHECK(stops([] { checked({.outline = {.depth_step = -1.0f}}); }));
    CHECK(stops([] { checked({.outline = {.normal_step_deg = 181.0f}}); }));
}

}  // namespace
}  // namespace rimline
