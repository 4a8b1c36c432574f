// Surfaces in the colors of their mesh, against the colors that a ray finds.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/srgb.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_mesh_color_size = 128;
constexpr double k_mesh_color_height = 4.0;  // Of the picture.
constexpr RendererOptions k_mesh_color_plain{.samples = 1, .scale = 1};
const glm::vec3 k_own(0.6f, 0.3f, 0.1f);  // Of what has no material.

// A cube from -1 to 1 whose sides -x, -y, -z, +x, +y, +z have the colors below; +y has no material.
constexpr std::array<glm::vec3, 6> k_colors{{{0.8f, 0.1f, 0.1f},
                                             {0.1f, 0.7f, 0.2f},
                                             {0.1f, 0.2f, 0.9f},
                                             {0.9f, 0.8f, 0.1f},
                                             {},
                                             {0.5f, 0.0f, 0.6f}}};

MeshSource colored_cube() {
    MeshSource cube;
    for (int i = 0; i < 8; ++i)
        cube.positions.push_back(
            {i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
    constexpr std::array<std::array<std::uint32_t, 4>, 6> k_sides{
        {{0, 4, 6, 2}, {0, 1, 5, 4}, {0, 2, 3, 1}, {1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}}};
    for (std::uint32_t s = 0; s < 6; ++s) {
        const auto& [a, b, c, d] = k_sides[s];
        cube.triangles.push_back({a, b, c});
        cube.triangles.push_back({a, c, d});
        cube.materials.materials.push_back({k_colors[s]});
        cube.materials.of_face.insert(cube.materials.of_face.end(), 2,
                                      s == 4 ? k_no_material : MaterialId{s});
    }
    return cube;
}

MeshSource without_materials(MeshSource source) {
    source.materials = {};
    return source;
}

Scene scene_of(const Model& model, Style style, const glm::dvec3& eye, const glm::dvec3& light) {
    Scene scene{.camera = {.eye = eye, .target = {0, 0, 0}, .ortho_height = k_mesh_color_height},
                .style = style,
                .palette = default_palette(style, style_defaults(style).background),
                .lines = false};
    scene.lights = {{.vector = light, .directional = true}};
    scene.instances.push_back({.octree = &model.octree, .material = {.color = k_own}});
    return scene;
}

// The side of the cube that a ray through the place (x, y) of the picture meets.
std::optional<int> side_at(const Camera& camera, double x, double y) {
    const glm::dmat3 world_from_camera = glm::transpose(camera_from_world(camera));
    const double pixel = k_mesh_color_height / k_mesh_color_size;
    const glm::dvec3 from =
        camera.eye + world_from_camera * glm::dvec3((x - 0.5 * k_mesh_color_size) * pixel,
                                                    (0.5 * k_mesh_color_size - y) * pixel, 0);
    const glm::dvec3 along = -world_from_camera[2];
    double enter = -1e9, leave = 1e9;
    int side = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double sign = along[axis] > 0 ? 1 : -1;
        const double begin = (-sign - from[axis]) / along[axis];
        if (begin > enter) {
            enter = begin;
            side = along[axis] > 0 ? axis : axis + 3;
        }
        leave = std::min(leave, (sign - from[axis]) / along[axis]);
    }
    return enter < leave ? std::optional(side) : std::nullopt;
}

int encoded(float linear) {
    return static_cast<int>(std::lround(255.0f * srgb_from_linear(glm::vec3(linear)).x));
}

bool is_color(const Picture& picture, std::size_t x, std::size_t y, const glm::vec3& linear) {
    // Surfaces are half floats: 11 bits.
    for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(picture.rgba[4 * (y * picture.width + x) + c] -
                     encoded(linear[static_cast<int>(c)])) > 1)
            return false;
    return true;
}

// Each side of the cube has `factor` times its color, away from edges.
void check_sides(const Picture& picture, const Camera& camera, const glm::vec3& factor) {
    std::array<int, 6> seen{};
    int wrong = 0;
    for (std::uint32_t y = 0; y < k_mesh_color_size; ++y)
        for (std::uint32_t x = 0; x < k_mesh_color_size; ++x) {
            const auto side = side_at(camera, x + 0.5, y + 0.5);
            if (!side) continue;
            bool is_inside = true;
            for (const double v : {-1.0, 2.0})
                for (const double u : {-1.0, 2.0})
                    is_inside = is_inside && side_at(camera, x + u, y + v) == side;
            if (!is_inside) continue;
            const auto number = static_cast<std::size_t>(*side);
            ++seen[number];
            wrong += !is_color(picture, x, y, factor * (*side == 4 ? k_own : k_colors[number]));
        }
    CHECK(wrong == 0);
    // Three sides are seen.
    CHECK(std::ranges::count_if(seen, [](int count) { return count > 300; }) == 3);
}

TEST_CASE("each face has its own color in light and in shade, in every style that shows colors") {
    RIMLINE_OPEN_GPU(gpu);
    const Model cube(colored_cube());
    Renderer renderer(gpu->context(), k_mesh_color_plain);
    for (const glm::dvec3 eye : {glm::dvec3(5, 4, 6), glm::dvec3(-6, -4, -5)})
        for (const Style style : {Style::toon, Style::ink, Style::hatch})
            for (const bool shadows : {false, true}) {
                CAPTURE(static_cast<int>(style));
                CAPTURE(shadows);
                // The cosine on the three sides is 0.577. Above 0.56 toon and ink show full light.
                for (const double towards : {1.0, -1.0}) {
                    const glm::dvec3 light = towards * glm::sign(eye);
                    Scene scene = scene_of(cube, style, eye, light);
                    scene.shadows = shadows;
                    // Without shade, hatch has no strokes.
                    if (style == Style::hatch) scene.palette.shade = glm::vec3(1.0f);
                    const Picture picture =
                        renderer.render(scene, k_mesh_color_size, k_mesh_color_size);
                    save_picture("mesh_colors_" + std::to_string(static_cast<int>(style)), picture,
                                 {});
                    check_sides(picture, scene.camera,
                                towards > 0 ? glm::vec3(1.0f) : scene.palette.shade);
                }
            }
}

TEST_CASE("colors of corners are interpolated in linear light and multiply that of the material") {
    RIMLINE_OPEN_GPU(gpu);
    MeshSource source{{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    const glm::vec3 base(0.5f, 1.0f, 0.25f);
    const auto corner = [](const glm::vec3& p) {
        return glm::vec3(0.5f + 0.25f * p.x, 0.5f - 0.25f * p.y, 0.25f * (2.0f + p.x));
    };
    source.materials.materials = {{base}};
    source.materials.of_face = {MaterialId{0}, MaterialId{0}};
    for (const auto& triangle : source.triangles)
        for (const std::uint32_t v : triangle)
            source.materials.corner_colors.push_back(corner(source.positions[v]));
    const Model square(source);
    const Scene scene = scene_of(square, Style::toon, {0, 0, 5}, {0, 0, 1});
    const Picture picture = Renderer(gpu->context(), k_mesh_color_plain)
                                .render(scene, k_mesh_color_size, k_mesh_color_size);
    int wrong = 0;
    for (std::uint32_t y = 2; y < k_mesh_color_size - 2; ++y)
        for (std::uint32_t x = 2; x < k_mesh_color_size - 2; ++x) {
            const float pixel = static_cast<float>(k_mesh_color_height) / k_mesh_color_size;
            const glm::vec3 place((static_cast<float>(x) + 0.5f) * pixel - 2.0f,
                                  2.0f - (static_cast<float>(y) + 0.5f) * pixel, 0);
            wrong += !is_color(picture, x, y, base * corner(place));
        }
    CHECK(wrong == 0);
}

TEST_CASE("thin triangles show no color that their corners do not have") {
    RIMLINE_OPEN_GPU(gpu);
    // A fifth of a pixel wide, more than a pixel apart, oblique: they cover every part of a pixel.
    constexpr float k_pixel = static_cast<float>(k_mesh_color_height) / k_mesh_color_size;
    const glm::vec3 low(0.3f, 0.5f, 0.4f), high(0.5f, 0.3f, 0.4f);
    MeshSource source;
    for (float x = -1.9f; x < 1.8f; x += 2.3f * k_pixel) {
        const auto v = static_cast<std::uint32_t>(source.positions.size());
        for (const float y : {-1.9f, 1.9f})
            for (const float aside : {0.0f, 0.2f * k_pixel})
                source.positions.emplace_back(x + 0.02f * y + aside, y, 0.0f);
        source.triangles.push_back({v, v + 1, v + 3});
        source.triangles.push_back({v, v + 3, v + 2});
        for (const glm::vec3& color : {low, high, high, low, high, low})
            source.materials.corner_colors.push_back(color);
    }
    source.materials.materials = {{glm::vec3(1.0f)}};
    source.materials.of_face.assign(source.triangles.size(), MaterialId{0});
    const Model slivers(source);
    Scene scene = scene_of(slivers, Style::toon, {0, 0, 5}, {0, 0, 1});
    scene.palette.background = 0.5f * (low + high);
    for (const bool shadows : {false, true}) {
        CAPTURE(shadows);
        scene.shadows = shadows;
        const Picture picture = Renderer(gpu->context(), {.samples = 4, .scale = 1})
                                    .render(scene, k_mesh_color_size, k_mesh_color_size);
        save_picture("thin_triangles", picture, {});
        int drawn = 0, wrong = 0;
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
            for (int c = 0; c < 3; ++c) {
                const int value = picture.rgba[i + static_cast<std::size_t>(c)];
                const int least = encoded(std::min(low[c], high[c]));
                const int most = encoded(std::max(low[c], high[c]));
                wrong += value < least - 1 || value > most + 1;
                drawn += std::abs(value - encoded(scene.palette.background[c])) > 1;
            }
        CHECK(wrong == 0);
        CHECK(drawn > 1000);
    }
}

TEST_CASE(
    "a mesh without materials, or whose colors are not shown, is drawn in its instance's color") {
    RIMLINE_OPEN_GPU(gpu);
    const Model colored(colored_cube());
    const Model bare(without_materials(colored_cube()));
    Renderer renderer(gpu->context(), k_mesh_color_plain);
    const auto draw = [&](const Model& model, Style style, bool shows_mesh_colors) {
        Scene scene = scene_of(model, style, {5, 4, 6}, {1, 2, 3});
        scene.instances[0].material.shows_mesh_colors = shows_mesh_colors;
        return renderer.render(scene, k_mesh_color_size, k_mesh_color_size).rgba;
    };
    for (const Style style :
         {Style::ink, Style::toon, Style::mask, Style::blueprint, Style::hatch}) {
        CAPTURE(static_cast<int>(style));
        const bool shows_colors = style != Style::mask && style != Style::blueprint;
        const auto expected = draw(bare, style, true);
        CHECK(draw(bare, style, false) == expected);
        CHECK(draw(colored, style, false) == expected);
        CHECK((draw(colored, style, true) == expected) == !shows_colors);
    }
    // One material of the instance's color for all faces gives the same picture, but for rounding.
    MeshSource alike = colored_cube();
    alike.materials.materials = {{k_own}};
    for (MaterialId& material : alike.materials.of_face) material = MaterialId{0};
    const Model own(alike);
    for (const Style style : {Style::ink, Style::toon, Style::hatch}) {
        const auto a = draw(own, style, true);
        const auto b = draw(bare, style, true);
        int greatest = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            greatest = std::max(greatest, std::abs(a[i] - b[i]));
        CHECK(greatest <= 1);
    }
}

TEST_CASE("colors take memory of the GPU only where a mesh has some") {
    RIMLINE_OPEN_GPU(gpu);
    const auto uploaded = [&](const MeshSource& source) {
        const Model model(source);
        Renderer renderer(gpu->context(), k_mesh_color_plain);
        renderer.render(scene_of(model, Style::toon, {5, 4, 6}, {1, 2, 3}), 16, 16);
        return renderer.report().bytes_uploaded;
    };
    MeshSource cube = colored_cube();
    const std::uint64_t bare = uploaded(without_materials(cube));
    // A base color of each material; the material of each face, and its ink, a byte.
    const std::uint64_t colored = bare + 12 * 6 + 4 * 12 + 12;
    CHECK(uploaded(cube) == colored);
    cube.materials.corner_colors.assign(36, glm::vec3(1.0f));
    CHECK(uploaded(cube) == colored + 12 * 36);
}

TEST_CASE("a mesh that deforms keeps the colors of its faces") {
    RIMLINE_OPEN_GPU(gpu);
    const Model cube(colored_cube());
    Renderer renderer(gpu->context(), k_mesh_color_plain);
    Scene scene = scene_of(cube, Style::toon, {5, 4, 6}, {1, 1, 1});
    scene.instances[0].octree = nullptr;
    scene.instances[0].deforming = &cube.mesh;
    check_sides(renderer.render(scene, k_mesh_color_size, k_mesh_color_size), scene.camera,
                glm::vec3(1.0f));
}

TEST_CASE("instances with and without colors share a scene, and styles change between frames") {
    RIMLINE_OPEN_GPU(gpu);
    const Model cube(colored_cube());
    const Model ground(MeshSource{{{-9, -1.5f, -9}, {9, -1.5f, -9}, {9, -1.5f, 9}, {-9, -1.5f, 9}},
                                  {{0, 2, 1}, {0, 3, 2}}});
    Renderer renderer(gpu->context(), k_mesh_color_plain);
    for (const Style style : {Style::toon, Style::blueprint, Style::hatch, Style::toon}) {
        Scene scene = scene_of(cube, style, {5, 4, 6}, {1, 1, 1});
        scene.instances.push_back(
            {.octree = &ground.octree, .material = {.color = glm::vec3(0.9f)}});
        const Picture picture = renderer.render(scene, k_mesh_color_size, k_mesh_color_size);
        CHECK(picture.rgba == Renderer(gpu->context(), k_mesh_color_plain)
                                  .render(scene, k_mesh_color_size, k_mesh_color_size)
                                  .rgba);
        if (style == Style::toon) check_sides(picture, scene.camera, glm::vec3(1.0f));
    }
}

}  // namespace
}  // namespace rimline
