#include "engine/frame/scene_check.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "engine/picture_lines.h"
#include "engine/renderer_options.h"
#include "engine/scene.h"
#include "engine/view_defaults.h"
#include "engine/vulkan/device_context.h"
#include "engine/vulkan/picture_target.h"
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
    CHECK_FALSE(stops_with([](Scene& s) { s.instances[0].scale = 1e-6; }));
    for (const double scale : {0.0, -1.0, k_nan})
        CHECK(stops_with([&](Scene& s) { s.instances[0].scale = scale; }));
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
    CHECK(stops_with([](Scene& s) { s.camera.projection = Projection{}; }));
    CHECK(stops_with([](Scene& s) {
        s.camera.projection = Projection{.scale = {1, -1}, .z = {0, k_nan}, .w = {-1, 0}};
    }));
    CHECK_FALSE(stops_with([](Scene& s) {
        s.camera.projection = Projection{.scale = {1, -1}, .z = {0, 0.1}, .w = {-1, 0}};
    }));
    CHECK(stops_with([](Scene& s) { s.instances[0].material.color.y = k_infinity; }));
    CHECK(stops_with([](Scene& s) { s.instances[0].material.line_color = glm::vec3(NAN); }));
    CHECK(stops_with([](Scene& s) { s.palette.background.x = k_infinity; }));
    CHECK(stops_with([](Scene& s) { s.palette.grid_strength = 1.5f; }));
    CHECK(stops_with([](Scene& s) { s.hidden_line_strength = -0.1f; }));
    CHECK(stops_with([](Scene& s) { s.line_width_px = -1.0f; }));
    CHECK(stops_with([](Scene& s) { s.line_width_px = k_infinity; }));
    CHECK(stops_with([](Scene& s) { s.dash_gap_px = -1.0f; }));
    CHECK(stops_with([](Scene& s) { s.crease_angle_deg = -1.0f; }));
    CHECK(stops_with([](Scene& s) { s.hatch_spacing_px = 0.0f; }));
}

TEST_CASE("lines of a picture without their colors and waves without a length stop the program") {
    const Mesh mesh(make_built_in_shape("box", 12));
    PictureLines lines{.points = {{0, 0}, {1, 1}}, .lines = {{0, 2}}};
    Scene scene;
    scene.instances.push_back({.deforming = &mesh, .picture_lines = &lines});
    CHECK_FALSE(stops([&] { check_scene(scene); }));
    lines.lines[0].color = 0;
    CHECK(stops([&] { check_scene(scene); }));
    lines.colors = {{0, 0, 0}};
    CHECK_FALSE(stops([&] { check_scene(scene); }));
    for (const Wave& wave : {Wave{.length = 0.0}, Wave{.direction = {0, k_nan, 0}},
                             Wave{.amplitude = k_nan}, Wave{.turns = HUGE_VAL}}) {
        scene.instances[0].deformation = wave;
        CHECK(stops([&] { check_scene(scene); }));
    }
    scene.instances[0].deformation = MovedPositions{.radius = -1.0};
    CHECK(stops([&] { check_scene(scene); }));
}

TEST_CASE("null handles and targets outside of their image stop the program") {
    const auto handle = [](auto& made) {
        made = reinterpret_cast<std::decay_t<decltype(made)>>(8);
    };
    PictureTarget target;
    CHECK(stops([&] { check_target(target); }));
    handle(target.image);
    handle(target.view);
    CHECK_FALSE(stops([&] { check_target(target); }));
    target.corner.x = -1;
    CHECK(stops([&] { check_target(target); }));
    target.corner.x = 0;
    BackdropDepth backdrop{.format = VK_FORMAT_D32_SFLOAT};
    target.backdrop = backdrop;
    CHECK(stops([&] { check_target(target); }));
    handle(backdrop.image);
    handle(backdrop.view);
    target.backdrop = backdrop;
    CHECK_FALSE(stops([&] { check_target(target); }));
    target.backdrop->format = VK_FORMAT_R8_UNORM;
    CHECK(stops([&] { check_target(target); }));
    CHECK(stops([] { checked(DeviceContext{}); }));
    CHECK(stops([] { make_device_context(HostDevice{}); }));
}

TEST_CASE("defaults for no direction and no aspect stop the program") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const glm::dvec3 none(0.0), up(0, 1, 0);
    CHECK_FALSE(stops([&] { fit_camera({}, mesh, up, 1.0); }));
    CHECK(stops([&] { fit_camera({}, mesh, up, 0.0); }));
    CHECK(stops([&] { fit_camera({}, mesh, none, 1.0); }));
    CHECK(stops([&] { fit_camera({.fov_y_deg = 0.0}, mesh, up, 1.0); }));
    CHECK(stops([&] { zoom_camera({.eye = {9, 0, 0}}, mesh, k_nan); }));
    CHECK(stops([&] { make_ground(mesh, none, 5.0); }));
    CHECK(stops([&] { default_view_direction(none); }));
    CHECK(stops([&] { default_wave(mesh, none, 0.0); }));
}

TEST_CASE("options of a renderer outside of their limits stop the program") {
    const auto stops_with = [](const RendererOptions& options) {
        return stops([&] { checked(options); });
    };
    CHECK_FALSE(stops_with({}));
    CHECK(stops_with({.frames_in_flight = 0}));
    CHECK(stops_with({.crease_angle_rad = -0.1f}));
    CHECK(stops_with({.outline = {.depth_step = -1.0f}}));
    CHECK(stops_with({.outline = {.normal_step_deg = 181.0f}}));
}

}  // namespace
}  // namespace rimline
