// What lines and strokes look like, by their areas: width, round ends, dashes, the tone of hatching. All
// of it on surfaces that face an orthographic camera, where a pixel is a known length.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <list>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/default_samplings.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_line_style_size = 256;

// The picture is 2 high: 128 pixels to the unit.
constexpr double k_line_style_height = 2.0;
constexpr double k_line_style_pixels = k_line_style_size / k_line_style_height;

Scene flat_scene(const HoughOctree& octree) {
    Scene scene{.camera = {.eye = {0, 0, 5}, .ortho_height = k_line_style_height},
                .palette = {.background = glm::vec3(1.0f),
                            .ink = glm::vec3(0.0f),
                            .shade = glm::vec3(1.0f)},
                .shadows = false};
    scene.instances.push_back({.octree = &octree});
    return scene;
}

Picture draw(const Gpu& gpu, const Scene& scene, const RendererOptions& options = {}) {
    Renderer renderer(gpu.context(), options);
    return renderer.render(scene, k_line_style_size, k_line_style_size);
}

// doctest's Approx adds 1 to what it takes a share of; shares of less than that would pass all.
bool is_close(double value, double expected, double share) {
    return std::abs(value - expected) <= share * std::abs(expected);
}

// A triangle so thin that its two long borders are one line, from one place to another.
MeshSource needle(const glm::vec2& from, const glm::vec2& to) {
    return {{glm::vec3(from, 0), glm::vec3(to, 0), glm::vec3(0.5f * (from + to), 1e-5f)},
            {{0, 1, 2}}};
}

TEST_CASE("a line's ink is its length times its width and the area of its round ends" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const glm::vec2 to : {glm::vec2(0.6f, 0.0f), {0.5f, 0.31f}, {0.2f, -0.55f}}) {
        const Model model(needle(-to, to));
        const double length_px = 2.0 * k_line_style_pixels * glm::length(to);
        for (const float width_px : {0.4f, 1.0f, 2.5f, 9.0f})
            for (const std::uint32_t scale : {1u, 2u}) {
                CAPTURE(to.y);
                CAPTURE(width_px);
                CAPTURE(scale);
                Scene scene = flat_scene(model.octree);
                scene.line_width_px = width_px;
                const double expected =
                    length_px * width_px + 0.25 * std::numbers::pi * width_px * width_px;
                const double ink = ink_of(draw(*gpu, scene, {.scale = scale}));
                CHECK(is_close(ink, expected, 0.03));
            }
    }
}

TEST_CASE("a line has the same ink at every angle, wherever it lies between pixels") {
    RIMLINE_OPEN_GPU(gpu);
    constexpr float k_width_px = 2.0f;
    std::list<Model> models;  // The renderer knows them by their addresses.
    Renderer renderer(gpu->context(), {.samples = 4, .scale = 1});
    for (double degrees = 0.0; degrees <= 90.0; degrees += 7.5)
        for (const float between : {0.0f, 0.2f, 0.45f, 0.7f}) {
            CAPTURE(degrees);
            CAPTURE(between);
            const glm::vec2 along(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)));
            const glm::vec2 aside =
                float(between / k_line_style_pixels) * glm::vec2(-along.y, along.x);
            const Model& model =
                models.emplace_back(needle(aside - 0.8f * along, aside + 0.8f * along));
            Scene scene = flat_scene(model.octree);
            scene.line_width_px = k_width_px;
            const double expected = 1.6 * k_line_style_pixels * k_width_px +
                                    0.25 * std::numbers::pi * k_width_px * k_width_px;
            const double ink = ink_of(renderer.render(scene, k_line_style_size, k_line_style_size));
            CHECK(is_close(ink, expected, 0.008));
        }
}

TEST_CASE("lines that meet at any angle join round, without a gap and without a bulge") {
    RIMLINE_OPEN_GPU(gpu);
    constexpr float k_width_px = 16.0f;
    for (const double degrees : {10.0, 45.0, 90.0, 135.0, 179.0}) {
        CAPTURE(degrees);
        const double angle = glm::radians(degrees);
        const glm::vec2 end(0.6 * std::cos(angle), 0.6 * std::sin(angle));
        MeshSource both = needle({0, 0}, {0.6f, 0});
        const MeshSource second = needle({0, 0}, end);
        both.positions.insert(both.positions.end(), second.positions.begin(),
                              second.positions.end());
        both.triangles.push_back({3, 4, 5});
        const Model model(both);
        Scene scene = flat_scene(model.octree);
        scene.line_width_px = k_width_px;
        const Picture picture = draw(*gpu, scene);
        // Inked is what lies within half a width of either segment, and nothing else.
        const auto from_segment = [](glm::dvec2 p, glm::dvec2 to) {
            const double t = std::clamp(glm::dot(p, to) / glm::dot(to, to), 0.0, 1.0);
            return glm::distance(p, t * to);
        };
        std::size_t wrong = 0;
        for (std::size_t y = 0; y < k_line_style_size; ++y)
            for (std::size_t x = 0; x < k_line_style_size; ++x) {
                const glm::dvec2 p((double(x) + 0.5) / k_line_style_pixels - 1.0,
                                   1.0 - (double(y) + 0.5) / k_line_style_pixels);
                const double away =
                    k_line_style_pixels *
                    std::min(from_segment(p, {0.6, 0}), from_segment(p, glm::dvec2(end)));
                const double ink = ink_at(picture, x, y);
                wrong += (away < 0.5 * k_width_px - 1.0 && ink < 0.99) ||
                         (away > 0.5 * k_width_px + 1.0 && ink > 0.01);
            }
        CHECK(wrong == 0);
    }
}

TEST_CASE("the edge of a line falls off over a pixel, evenly") {
    RIMLINE_OPEN_GPU(gpu);
    // Rises one pixel in eight columns: each column sees the edge an eighth of a pixel higher.
    const Model model(needle({-1.5f, -1.5f / 8}, {1.5f, 1.5f / 8}));
    Scene scene = flat_scene(model.octree);
    scene.line_width_px = 20.0f;
    for (const RendererOptions& sampling : k_default_samplings) {
        const Picture picture = draw(*gpu, scene, sampling);
        double previous = 0.0;
        for (std::size_t x = 60; x < 180; ++x) {
            double column = 0.0;
            for (std::size_t y = 0; y < 128; ++y) column += ink_at(picture, x, y);
            if (x > 60) CHECK(is_close(column - previous, 0.125, 0.35));
            previous = column;
        }
    }
}

TEST_CASE("a line is whole on its own surface at every slant and hidden by what lies before it" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    // Two long faces that bend by 20 degrees over the x axis.
    const float drop = 3.0f * std::tan(glm::radians(10.0f));
    const Model hinge(MeshSource{{{-0.5f, 0, 0},
                                  {0.5f, 0, 0},
                                  {0.5f, 3, -drop},
                                  {-0.5f, 3, -drop},
                                  {-0.5f, -3, -drop},
                                  {0.5f, -3, -drop}},
                                 {{0, 1, 2}, {0, 2, 3}, {1, 0, 4}, {1, 4, 5}}});
    const Model plate(
        MeshSource{{{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    for (const double degrees : {0.0, 30.0, 60.0, 75.0, 77.0})
        for (const bool orthographic : {true, false}) {
            CAPTURE(degrees);
            CAPTURE(orthographic);
            const double angle = glm::radians(degrees);
            Scene scene = flat_scene(hinge.octree);
            scene.camera.eye = {0, 5 * std::sin(angle), 5 * std::cos(angle)};
            scene.camera.fov_y_deg = 2.0 * glm::degrees(std::atan(k_line_style_height / 10.0));
            if (!orthographic) scene.camera.ortho_height = 0.0;
            scene.line_width_px = 2.0f;
            const double borders = ink_of(draw(*gpu, scene));
            scene.crease_angle_deg = 15.0f;
            const double creased = ink_of(draw(*gpu, scene));
            // The crease is as wide as the model; its ends lie on borders.
            CHECK(is_close(creased - borders, 2.0 * (k_line_style_pixels - 2.0), 0.06));

            // A plate over the hinge, a ten-thousandth of the distance before the crease.
            SceneInstance before{.octree = &plate.octree, .has_lines = false};
            before.translation.z = 1e-4 * glm::length(scene.camera.eye);
            scene.instances.push_back(before);
            const double behind_plate = ink_of(draw(*gpu, scene));
            scene.crease_angle_deg = 0.0f;
            CHECK(behind_plate - ink_of(draw(*gpu, scene)) == 0.0);
        }
}

// A square in front of everything with a needle behind it.
MeshSource hidden_needle(const glm::vec2& from, const glm::vec2& to, int parts) {
    MeshSource source{{{-3, -3, 1}, {3, -3, 1}, {3, 3, 1}, {-3, 3, 1}}, {{0, 1, 2}, {0, 2, 3}}};
    for (int i = 0; i <= parts; ++i) {
        const glm::vec2 place = from + (to - from) * (float(i) / float(parts));
        source.positions.emplace_back(place, 0.0f);
        source.positions.emplace_back(place, -0.5f);
    }
    // A strip seen edge-on.
    for (std::uint32_t i = 0; i < std::uint32_t(parts); ++i) {
        const std::uint32_t a = 4 + 2 * i;
        source.triangles.push_back({a, a + 2, a + 1});
        source.triangles.push_back({a + 1, a + 2, a + 3});
    }
    return source;
}

TEST_CASE("dashes of hidden lines take their share and join however finely a line is divided" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const RendererOptions& sampling : k_default_samplings) {
        std::list<Model> models;  // The renderer knows them by their addresses.
        Renderer renderer(gpu->context(), sampling);
        for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0, 130.0, 175.0}) {
            CAPTURE(degrees);
            const glm::vec2 to(0.8 * std::cos(glm::radians(degrees)),
                               0.8 * std::sin(glm::radians(degrees)));
            std::optional<Picture> whole;
            for (const int parts : {1, 7, 60}) {
                const Model& model = models.emplace_back(hidden_needle(-to, to, parts));
                Scene scene = flat_scene(model.octree);
                scene.line_width_px = 2.0f;
                CHECK(ink_of(renderer.render(scene, k_line_style_size, k_line_style_size)) < 1.0);
                scene.hidden_line_strength = 1.0f;
                const Picture dashed = renderer.render(scene, k_line_style_size, k_line_style_size);
                scene.dash_gap_px = 0.0f;
                const double solid_ink =
                    ink_of(renderer.render(scene, k_line_style_size, k_line_style_size));
                CHECK(
                    is_close(solid_ink, 1.6 * k_line_style_pixels * 2.0 + std::numbers::pi, 0.01));
                // The ends may each cut a dash or a gap short.
                const double share = ink_of(dashed) / solid_ink;
                CAPTURE(share);
                CHECK(is_close(share, 7.0 / 11.5, 0.08));
                if (!whole) whole = dashed;
                double difference = 0.0;
                for (std::size_t i = 0; i < dashed.rgba.size(); i += 4)
                    difference += std::abs(linear_from_srgb(dashed.rgba[i]) -
                                           linear_from_srgb(whole->rgba[i]));
                CHECK(difference < 0.02 * solid_ink);
            }
        }
    }
}

TEST_CASE(
    "creases are all edges that bend by an angle, or those that stand out from a rough surface") {
    RIMLINE_OPEN_GPU(gpu);
    const Model box(make_built_in_shape("box", 12));
    MeshSource source;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> height(-0.4f, 0.4f);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x)
            source.positions.emplace_back(float(x), float(y), height(random));
    for (std::uint32_t y = 0; y < 23; ++y)
        for (std::uint32_t x = 0; x < 23; ++x) {
            const std::uint32_t at = 24 * y + x;
            source.triangles.push_back({at, at + 1, at + 25});
            source.triangles.push_back({at, at + 25, at + 24});
        }
    const Model rough(source);
    const auto creases = [&](const Model& model, bool only_clear) {
        Scene scene = flat_scene(model.octree);
        scene.crease_angle_deg = 30.0f;
        scene.only_clear_creases = only_clear;
        Renderer renderer(gpu->context());
        renderer.render(scene, 16, 16);
        return renderer.report().creases;
    };
    CHECK(creases(box, false) == 12);
    CHECK(creases(box, true) == 12);
    CHECK(creases(rough, false) > 100);
    CHECK(creases(rough, true) < creases(rough, false) / 10);
}

TEST_CASE("hatching has the tone it stands for at every distance" * doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(
        MeshSource{{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    for (const double height : {2.0, 2.3, 2.7, 3.2, 4.1, 6.5})
        for (const float left : {0.9f, 0.7f, 0.4f}) {
            CAPTURE(height);
            CAPTURE(left);
            Scene scene = flat_scene(model.octree);
            scene.camera.ortho_height = height;
            scene.style = Style::hatch;
            scene.lines = false;
            scene.palette.shade = glm::vec3(left);  // Without lights everything is in shadow.
            const double ink =
                ink_of(draw(*gpu, scene)) / (double{k_line_style_size} * k_line_style_size);
            CHECK(is_close(ink, 1.0 - left, 0.08));
        }
}

TEST_CASE("the stroke through the center of a mesh has one width on both sides of it") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(
        MeshSource{{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    constexpr double k_density = 0.2;
    Scene scene = flat_scene(model.octree);
    scene.style = Style::hatch;
    scene.lines = false;
    scene.palette.shade = glm::vec3(static_cast<float>(1.0 - k_density));
    scene.hatch_spacing_px = 80.0f;
    const Picture picture = draw(*gpu, scene, {.samples = 1, .scale = 1});
    // As hatch.glsl says, of a stroke whose random number is 0.
    const double across = std::hypot(0.5345, 0.8018);  // Of the first layer, on the screen.
    const double level = std::log2(80.0 * across / k_line_style_pixels);
    const double pixels = std::exp2(std::floor(level)) / across * k_line_style_pixels;
    const double width = 1.6 * k_density * pixels / (2.0 - (level - std::floor(level)));
    // Along a row, from the middle of the stroke.
    constexpr std::size_t k_row = k_line_style_size / 2;
    const auto middle = k_row + static_cast<std::size_t>(0.08 * pixels * across / 0.5345);
    REQUIRE(ink_at(picture, middle, k_row) == 1.0);
    double seen = 0.0;
    for (std::size_t x = middle; ink_at(picture, x, k_row) > 0.0; ++x)
        seen += ink_at(picture, x, k_row);
    for (std::size_t x = middle - 1; ink_at(picture, x, k_row) > 0.0; --x)
        seen += ink_at(picture, x, k_row);
    CHECK(is_close(seen * 0.5345 / across, width, 0.05));
}

TEST_CASE("light takes strokes away, and where there is enough of it none is left") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(
        MeshSource{{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    double previous = 1e9;
    for (const double cosine : {0.1, 0.25, 0.4, 0.6, 0.9}) {
        CAPTURE(cosine);
        Scene scene = flat_scene(model.octree);
        scene.style = Style::hatch;
        scene.lines = false;
        scene.shadows = true;
        scene.palette.shade = glm::vec3(0.5f);
        scene.lights = {{.vector = {std::sqrt(1 - cosine * cosine), 0, cosine}}};
        const double ink = ink_of(draw(*gpu, scene));
        CHECK(ink < previous);
        if (cosine == 0.9) CHECK(ink == 0.0);
        previous = ink;
    }
}

TEST_CASE("a grid lies over paper and surfaces, under the ink, where its strength asks for it") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(needle({-0.5f, 0.013f}, {0.5f, 0.013f}));
    Scene scene = flat_scene(model.octree);
    const Picture plain = draw(*gpu, scene);
    scene.palette.grid = {1.0f, 0.0f, 0.0f};
    scene.palette.grid_strength = 0.5f;
    const Picture ruled = draw(*gpu, scene);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < plain.rgba.size(); i += 4) {
        const bool inked = plain.rgba[i] == 0;
        const bool same = std::equal(&plain.rgba[i], &plain.rgba[i] + 4, &ruled.rgba[i]);
        if (inked) CHECK(same);
        changed += same ? 0u : 1u;
    }
    // A line a pixel wide every 16 pixels, either way: of 256 x 256 pixels those off all lines stay.
    CHECK(changed > 65536 - 240 * 240 - 600);
    CHECK(changed <= 65536 - 239 * 239);
}

}  // namespace
}  // namespace rimline
