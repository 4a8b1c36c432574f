// Outlines of pixels (Outline, renderer_options.h), on pictures whose outlines have a closed form. Models are
// white on white and without light, so that a picture is the mask of its outlines.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_outline_size = 256;
constexpr double k_outline_height = 2.0;  // Of pictures by orthographic cameras.

const Outline k_sobel{.method = OutlineMethod::sobel};
const Outline k_backs{.method = OutlineMethod::backs};

Scene white_scene(const Camera& camera, std::initializer_list<const Model*> models) {
    Scene scene{.camera = camera,
                .palette = {.background = glm::vec3(1.0f),
                            .ink = glm::vec3(0.0f),
                            .shade = glm::vec3(1.0f)},
                .shadows = false,
                .line_width_px = 2.0f};
    for (const Model* model : models) scene.instances.push_back({.octree = &model->octree});
    return scene;
}

Picture draw_outline(const Gpu& gpu, const Scene& scene, const Outline& outline,
                     std::uint32_t samples = 1) {
    Renderer renderer(gpu.context(), {.samples = samples, .scale = 1, .outline = outline});
    return renderer.render(scene, k_outline_size, k_outline_size);
}

bool is_marked(const Picture& picture, const glm::dvec2& place) {
    const auto x = static_cast<std::size_t>(place.x);
    const auto y = static_cast<std::size_t>(place.y);
    return ink_at(picture, y * k_outline_size + x) > 0.5;
}

std::vector<glm::dvec2> marked_pixels(const Picture& picture) {
    std::vector<glm::dvec2> pixels;
    for (std::size_t pixel = 0; pixel < std::size_t{k_outline_size} * k_outline_size; ++pixel)
        if (ink_at(picture, pixel) > 0.5)
            pixels.push_back(glm::dvec2(pixel % k_outline_size, pixel / k_outline_size) + 0.5);
    return pixels;
}

// A square across the view, of so many units to each side of the middle.
MeshSource square(float half, float z) {
    return {{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
            {{0, 1, 2}, {0, 2, 3}}};
}

MeshSource cube() {
    MeshSource source{{}, {}};
    for (int corner = 0; corner < 8; ++corner)
        source.positions.push_back({(corner & 1) != 0 ? 1.0f : -1.0f,
                                    (corner & 2) != 0 ? 1.0f : -1.0f,
                                    (corner & 4) != 0 ? 1.0f : -1.0f});
    source.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return source;
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(p, a + t * (b - a));
}

constexpr double k_sphere_eye = 4.0;
const Camera k_sphere_camera{.eye = {0, 0, k_sphere_eye}, .fov_y_deg = 40.0};

// The radius of the silhouette of the unit sphere, in pixels: the rays that touch it form a cone.
double sphere_radius_px() {
    const double pixels = 0.5 * k_outline_size / std::tan(glm::radians(20.0));
    return pixels / std::sqrt(k_sphere_eye * k_sphere_eye - 1.0);
}

TEST_CASE("the Sobel outline of a sphere is a ring of a pixel to each side of its circle") {
    RIMLINE_OPEN_GPU(gpu);
    const Model sphere(make_built_in_shape("sphere", 20'000));
    REQUIRE(sphere.mesh.radius() == doctest::Approx(1.0).epsilon(1e-3));
    const double radius = sphere_radius_px();
    const Picture picture = draw_outline(*gpu, white_scene(k_sphere_camera, {&sphere}), k_sobel);
    const glm::dvec2 center(0.5 * k_outline_size);
    for (const glm::dvec2& pixel : marked_pixels(picture))
        CHECK(std::abs(glm::distance(pixel, center) - radius) < std::numbers::sqrt2 + 0.2);
    for (double degrees = 0.0; degrees < 360.0; degrees += 0.5) {
        CAPTURE(degrees);
        const double angle = glm::radians(degrees);
        const glm::dvec2 outwards(std::cos(angle), std::sin(angle));
        CHECK(is_marked(picture, center + radius * outwards));
    }
}

TEST_CASE("the thickened backs of a sphere are a ring of the line's width outside its circle" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model sphere(make_built_in_shape("sphere", 20'000));
    const double radius = sphere_radius_px();
    const glm::dvec2 center(0.5 * k_outline_size);
    for (const float width : {1.0f, 2.0f, 5.0f, 40.0f})
        for (const std::uint32_t samples : {1u, 4u}) {
            CAPTURE(width);
            CAPTURE(samples);
            Scene scene = white_scene(k_sphere_camera, {&sphere});
            scene.line_width_px = width;
            const Picture picture = draw_outline(*gpu, scene, k_backs, samples);
            const double outer = radius + double{width};
            const double area = std::numbers::pi * (outer * outer - radius * radius);
            CHECK(std::abs(ink_of(picture) - area) < (samples == 1 ? 0.04 : 0.02) * area);
            for (const glm::dvec2& pixel : marked_pixels(picture)) {
                const double away = glm::distance(pixel, center);
                CHECK(away > radius - 0.75);
                CHECK(away < outer + 0.75);
            }
        }
}

TEST_CASE("Sobel finds the inner edges of a cube only where they bend by its threshold") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(cube());
    const Camera camera{.eye = {6, 5, 7}, .fov_y_deg = 30.0};
    std::array<glm::dvec2, 8> corners;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p =
            camera_from_world(camera) * (glm::dvec3(model.mesh.positions()[corner]) - camera.eye);
        const double pixels = 0.5 * k_outline_size / std::tan(glm::radians(15.0));
        corners[corner] = 0.5 * k_outline_size + pixels * glm::dvec2(p.x, -p.y) / -p.z;
    }
    using Edges = std::vector<std::array<std::size_t, 2>>;
    const Edges outer{{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
    const Edges inner{{7, 3}, {7, 5}, {7, 6}};
    for (const float threshold : {60.0f, 120.0f}) {
        CAPTURE(threshold);
        Outline outline = k_sobel;
        outline.normal_step_deg = threshold;
        const Picture picture = draw_outline(*gpu, white_scene(camera, {&model}), outline);
        const auto check_edges = [&](const Edges& edges, bool found) {
            for (const auto& [a, b] : edges)
                for (double t = 0.1; t < 0.91; t += 0.02)
                    CHECK(is_marked(picture, glm::mix(corners[a], corners[b], t)) == found);
        };
        check_edges(outer, true);
        check_edges(inner, threshold < 90.0f);
        Edges drawn = outer;
        if (threshold < 90.0f) drawn.insert(drawn.end(), inner.begin(), inner.end());
        for (const glm::dvec2& pixel : marked_pixels(picture)) {
            double nearest = k_outline_size;
            for (const auto& [a, b] : drawn)
                nearest = std::min(nearest, distance_to_segment(pixel, corners[a], corners[b]));
            CHECK(nearest < std::numbers::sqrt2 + 0.1);
        }
    }
}

TEST_CASE("a step of depth is a share of the picture's height, for every camera") {
    RIMLINE_OPEN_GPU(gpu);
    constexpr float k_step = 0.02f;  // A hundredth of the height.
    const Model wall(square(3.0f, 0.0f));
    const Model plate(square(0.5f, k_step));
    const double distance = 5.0;
    const double fov_deg = 2.0 * glm::degrees(std::atan(0.5 * k_outline_height / distance));
    for (const Camera& camera : {Camera{.eye = {0, 0, distance}, .fov_y_deg = fov_deg},
                                 Camera{.eye = {0, 0, distance}, .ortho_height = k_outline_height}})
        for (const float threshold : {0.009f, 0.0115f}) {
            CAPTURE(camera.is_orthographic());
            CAPTURE(threshold);
            Outline outline = k_sobel;
            outline.depth_step = threshold;
            const Picture picture =
                draw_outline(*gpu, white_scene(camera, {&wall, &plate}), outline);
            // The edge of the plate is at a quarter and three quarters of the picture.
            const bool is_found = threshold < 0.01f;
            for (double y = 80.0; y < 176.0; y += 1.0)
                CHECK(is_marked(picture, {0.75 * k_outline_size - 0.5, y}) == is_found);
            CHECK(marked_pixels(picture).empty() == !is_found);
        }
}

TEST_CASE("the slope of a surface is no step of depth") {
    RIMLINE_OPEN_GPU(gpu);
    // Rises by 5.7 pixels for each pixel.
    const float tangent = std::tan(glm::radians(80.0f));
    const Model slope(MeshSource{{{-0.5f, -0.5f, -0.5f * tangent},
                                  {0.5f, -0.5f, -0.5f * tangent},
                                  {0.5f, 0.5f, 0.5f * tangent},
                                  {-0.5f, 0.5f, 0.5f * tangent}},
                                 {{0, 1, 2}, {0, 2, 3}}});
    for (const Camera& camera : {Camera{.eye = {0, 0, 20}, .fov_y_deg = 6.0},
                                 Camera{.eye = {0, 0, 20}, .ortho_height = k_outline_height}}) {
        CAPTURE(camera.is_orthographic());
        const Picture picture = draw_outline(*gpu, white_scene(camera, {&slope}), k_sobel);
        for (double x = 84.0; x < 172.0; x += 4.0)
            for (double y = 90.0; y < 160.0; y += 1.0) CHECK(!is_marked(picture, {x, y}));
        CHECK(!marked_pixels(picture).empty());
    }
}

TEST_CASE("the Sobel outline is the same at one sample and at four, and over no background") {
    RIMLINE_OPEN_GPU(gpu);
    const Model knot(make_built_in_shape("knot", 6000));
    Scene scene = white_scene({.eye = {0, 1, 4}, .fov_y_deg = 50.0}, {&knot});
    const Picture picture = draw_outline(*gpu, scene, k_sobel);
    const Picture multisampled = draw_outline(*gpu, scene, k_sobel, 4);
    CHECK(!marked_pixels(picture).empty());
    CHECK(picture.rgba == multisampled.rgba);
    scene.has_background = false;
    const Picture layer = draw_outline(*gpu, scene, k_sobel);
    for (const glm::dvec2& pixel : marked_pixels(picture)) {
        const std::size_t at = std::size_t(pixel.y) * k_outline_size + std::size_t(pixel.x);
        CHECK(layer.rgba[4 * at] == 0);
        CHECK(layer.rgba[4 * at + 3] == 255);
    }
}

TEST_CASE(
    "outlines of pixels follow no silhouette and draw no outlines of instances without lines") {
    RIMLINE_OPEN_GPU(gpu);
    const Model sphere(make_built_in_shape("sphere", 2000));
    const Model wall(square(3.0f, 1.5f));
    for (const Outline& outline : {k_sobel, k_backs}) {
        CAPTURE(int(outline.method));
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1, .outline = outline});
        Scene scene = white_scene(k_sphere_camera, {&sphere, &wall});
        scene.instances[1].has_lines = false;
        CHECK(marked_pixels(renderer.render(scene, k_outline_size, k_outline_size)).empty());
        CHECK(renderer.report().silhouette == 0);
        CHECK(renderer.tracker_bytes() == 0);
        CHECK(renderer.stream_bytes() == 0);
        scene.instances.pop_back();
        CHECK(!marked_pixels(renderer.render(scene, k_outline_size, k_outline_size)).empty());
        scene.lines = false;
        CHECK(marked_pixels(renderer.render(scene, k_outline_size, k_outline_size)).empty());
    }
}

TEST_CASE("thickened backs have the colors of their lines") {
    RIMLINE_OPEN_GPU(gpu);
    const Model sphere(make_built_in_shape("sphere", 2000));
    Scene scene = white_scene(k_sphere_camera, {&sphere});
    scene.instances[0].material.line_color = glm::vec3(0.0f, 1.0f, 0.0f);
    for (const bool has_background : {true, false}) {
        scene.has_background = has_background;
        const Picture picture = draw_outline(*gpu, scene, k_backs);
        std::size_t green = 0;
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
            green +=
                picture.rgba[i] == 0 && picture.rgba[i + 1] == 255 && picture.rgba[i + 3] == 255;
        CHECK(green > 500);
    }
}

}  // namespace
}  // namespace rimline
