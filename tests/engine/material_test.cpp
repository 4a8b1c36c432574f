// Lines in the colors of their materials: each as if the whole picture were drawn with that ink.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/material_inks.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_material_width = 240;
constexpr std::uint32_t k_material_height = 80;
constexpr RendererOptions k_material_plain{.samples = 1, .scale = 2};

constexpr std::array<glm::vec3, 3> k_inks{{{0.8f, 0.05f, 0.02f}, {0.0f, 0.3f, 0.7f}, {0, 0, 0}}};
constexpr std::array k_paths{LinePath::geometry, LinePath::pulling, LinePath::all_edges,
                             LinePath::quads, LinePath::adjacency};

// Three of a model beside one another, each in its third of the picture; the last has the palette's ink.
Scene scene_of(const Model& model, Style style, double distance) {
    const StyleDefaults defaults = style_defaults(style);
    const double radius = model.mesh.radius();
    Scene scene{.camera = {.eye = model.mesh.center() + glm::dvec3(1.0, 2.0, 6.0) * radius,
                           .target = model.mesh.center(),
                           .ortho_height = 2.4 * radius},
                .style = style,
                .palette = default_palette(style, defaults.background),
                .line_width_px = defaults.line_width_px,
                .hidden_line_strength = 0.6f,
                .crease_angle_deg = 40.0f};
    scene.palette.ink = k_inks[2];
    const glm::dvec3 right =
        glm::transpose(camera_from_world(scene.camera)) * glm::dvec3(distance * radius, 0, 0);
    for (int i = 0; i < 3; ++i) {
        SceneInstance instance{
            .octree = &model.octree,
            .rotation = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7 * i, glm::dvec3(0.3, 1, 0.2))),
            .material = {.color = default_surface_color(style, defaults.background)}};
        instance.translation =
            model.mesh.center() - instance.rotation * model.mesh.center() + double(i - 1) * right;
        if (i < 2) instance.material.line_color = k_inks[static_cast<std::size_t>(i)];
        scene.instances.push_back(instance);
    }
    scene.lights = {default_sun(scene.camera)};
    return scene;
}

// The same with one ink for all.
Scene inked(Scene scene, const glm::vec3& ink) {
    scene.palette.ink = ink;
    for (SceneInstance& instance : scene.instances) instance.material.line_color.reset();
    return scene;
}

Picture draw_materials(const Gpu& gpu, const Scene& scene, LinePath path) {
    RendererOptions options = k_material_plain;
    options.line_path = path;
    return Renderer(gpu.context(), options).render(scene, k_material_width, k_material_height);
}

int channel(const Picture& picture, std::size_t x, std::size_t y, std::size_t c) {
    return picture.rgba[4 * (y * picture.width + x) + c];
}

// The greatest difference of a channel in columns [begin, end).
int difference(const Picture& a, const Picture& b, std::size_t begin, std::size_t end) {
    int greatest = 0;
    for (std::size_t y = 0; y < a.height; ++y)
        for (std::size_t x = begin; x < end; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                greatest = std::max(greatest, std::abs(channel(a, x, y, c) - channel(b, x, y, c)));
    return greatest;
}

TEST_CASE("lines have the color of their material in every style and on every line path" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("knot", 1200));
    for (const Style style : {Style::ink, Style::toon, Style::blueprint, Style::hatch}) {
        CAPTURE(static_cast<int>(style));
        const Scene scene = scene_of(model, style, 2.4);
        Renderer renderer(gpu->context(), k_material_plain);
        const Picture colored = renderer.render(scene, k_material_width, k_material_height);
        save_picture("material_" + std::to_string(static_cast<int>(style)), colored, {});
        std::array<Picture, 3> alone;
        for (std::size_t i = 0; i < 3; ++i)
            alone[i] =
                renderer.render(inked(scene, k_inks[i]), k_material_width, k_material_height);
        for (std::size_t third = 0; third < 3; ++third) {
            CAPTURE(third);
            const std::size_t begin = third * k_material_width / 3;
            const std::size_t end = begin + k_material_width / 3;
            // Ink that is laid on the surfaces first is rounded there to half floats, to 11 bits.
            CHECK(difference(colored, alone[third], begin, end) <= 1);
            CHECK(difference(colored, alone[(third + 1) % 3], begin, end) > 60);
        }
        for (const LinePath path : k_paths) {
            CAPTURE(static_cast<int>(path));
            CHECK(draw_materials(*gpu, scene, path).rgba == colored.rgba);
        }
    }
}

TEST_CASE("lines of several colors over one another are the same pixels on every line path" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("spring", 2000));
    for (const Style style : {Style::ink, Style::blueprint, Style::hatch}) {
        const Scene scene = scene_of(model, style, 0.4);
        const Picture expected = draw_materials(*gpu, scene, LinePath::geometry);
        for (const LinePath path : k_paths) {
            CAPTURE(static_cast<int>(path));
            CHECK(draw_materials(*gpu, scene, path).rgba == expected.rgba);
        }
    }
}

TEST_CASE("a material whose lines are the palette's ink draws as one that names no color") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("knot", 1200));
    const Scene unnamed = inked(scene_of(model, Style::blueprint, 2.4), k_inks[0]);
    Scene named = unnamed;
    for (SceneInstance& instance : named.instances) instance.material.line_color = k_inks[0];
    Renderer renderer(gpu->context(), k_material_plain);
    CHECK(renderer.render(named, k_material_width, k_material_height).rgba ==
          renderer.render(unnamed, k_material_width, k_material_height).rgba);
}

// Two upright rectangles, borders all around, whose outlines cross at right angles.
TEST_CASE("where lines cross, that of the color named later lies over the other") {
    RIMLINE_OPEN_GPU(gpu);
    const auto rectangle = [](float x, float y, float z) {
        MeshSource source;
        source.positions = {{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}};
        source.triangles = {{0, 1, 2}, {0, 2, 3}};
        return source;
    };
    // Neither hides the other's border: they are seen from the side where both are in front.
    const Model wide(rectangle(0.8f, 0.3f, 0.0f));
    const Model high(rectangle(0.3f, 0.8f, 0.0f));
    // 64 pixels to the unit.
    Scene scene{.camera = {.eye = {0, 0, 5}, .ortho_height = 2.0},
                .palette = {.background = glm::vec3(1.0f), .shade = glm::vec3(1.0f)},
                .shadows = false,
                .line_width_px = 6.0f,
                .hidden_line_strength = 1.0f,
                .dash_gap_px = 0.0f};
    for (const Model* model : {&wide, &high}) scene.instances.push_back({.octree = &model->octree});
    scene.instances[0].material.line_color = glm::vec3(1, 0, 0);
    scene.instances[1].material.line_color = glm::vec3(0, 0, 1);
    const Picture picture = Renderer(gpu->context(), k_material_plain).render(scene, 128, 128);
    const auto is = [&](double x, double y, std::array<int, 3> color) {
        const auto column = static_cast<std::size_t>(64.0 + 64.0 * x);
        const auto row = static_cast<std::size_t>(64.0 - 64.0 * y);
        for (std::size_t c = 0; c < 3; ++c)
            if (channel(picture, column, row, c) != color[c]) return false;
        return true;
    };
    constexpr std::array k_red{255, 0, 0};
    constexpr std::array k_blue{0, 0, 255};
    CHECK(is(0.6, 0.3, k_red));
    CHECK(is(-0.8, 0.0, k_red));
    CHECK(is(0.3, 0.6, k_blue));
    for (const double x : {-0.3, 0.3})
        for (const double y : {-0.3, 0.3}) CHECK(is(x, y, k_blue));
    std::swap(scene.instances[0], scene.instances[1]);
    const Picture swapped = Renderer(gpu->context(), k_material_plain).render(scene, 128, 128);
    CHECK(channel(swapped, 64 + 19, 64 - 19, 0) == 255);
    CHECK(channel(swapped, 64 + 19, 64 - 19, 2) == 0);
}

// Two knots in one mesh, beside each other, each of its own material, and a third without one.
MeshSource three_knots() {
    const MeshSource knot = make_built_in_shape("knot", 1200);
    MeshSource all;
    for (int i = 0; i < 3; ++i) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (const glm::vec3& p : knot.positions)
            all.positions.push_back(p + glm::vec3(float(i - 1) * 6.5f, 0.0f, 0.0f));
        for (const auto& triangle : knot.triangles) {
            all.triangles.push_back(
                {triangle[0] + first, triangle[1] + first, triangle[2] + first});
            all.materials.of_face.push_back(i < 2 ? MaterialId{static_cast<std::uint32_t>(i)}
                                                  : k_no_material);
        }
    }
    all.materials.materials = {{.base_color = {1.0f, 0.1f, 0.0f}},
                               {.base_color = {0.0f, 0.4f, 1.0f}}};
    return all;
}

TEST_CASE("lines have shades of the materials of their faces while the model deforms too" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(three_knots());
    const std::array surfaces{glm::vec3(1.0f, 0.1f, 0.0f), glm::vec3(0.0f, 0.4f, 1.0f)};
    for (const bool deforms : {false, true})
        for (const bool on_dark : {false, true}) {
            CAPTURE(deforms);
            CAPTURE(on_dark);
            const glm::vec3 paper(on_dark ? 0.02f : 0.9f);
            Scene scene{.camera = {.eye = model.mesh.center() + glm::dvec3(0, 0, 40),
                                   .target = model.mesh.center(),
                                   .ortho_height = 6.5},
                        .style = Style::toon,
                        .palette = {.background = paper, .ink = k_inks[2]},
                        .hidden_line_strength = 0.6f,
                        .crease_angle_deg = 40.0f};
            if (on_dark) scene.palette.ink = glm::vec3(1.0f);
            scene.lights = {default_sun(scene.camera)};
            SceneInstance instance{.material = {.color = paper, .shows_mesh_colors = false}};
            if (deforms)
                instance.deforming = &model.mesh;
            else
                instance.octree = &model.octree;
            scene.instances = {instance};
            std::array<Picture, 3> alone;
            for (std::size_t i = 0; i < 3; ++i) {
                if (i < 2)
                    scene.instances[0].material.line_color = line_shade(surfaces[i], on_dark);
                else
                    scene.instances[0].material.line_color.reset();
                alone[i] = draw_materials(*gpu, scene, LinePath::geometry);
            }
            scene.instances[0].material.lines_in_mesh_colors = true;
            for (const LinePath path : {LinePath::geometry, LinePath::pulling}) {
                const Picture colored = draw_materials(*gpu, scene, path);
                save_picture("material_lines", colored, {});
                for (std::size_t third = 0; third < 3; ++third) {
                    CAPTURE(third);
                    const std::size_t begin = third * k_material_width / 3;
                    const std::size_t end = begin + k_material_width / 3;
                    CHECK(difference(colored, alone[third], begin, end) <= 1);
                    CHECK(difference(colored, alone[(third + 1) % 3], begin, end) > 20);
                }
            }
            // Paths that test every edge have one color, as have styles without colors.
            CHECK((deforms ||
                   draw_materials(*gpu, scene, LinePath::all_edges).rgba == alone[2].rgba));
            scene.style = Style::blueprint;
            const Picture blueprint = draw_materials(*gpu, scene, LinePath::geometry);
            scene.instances[0].material.lines_in_mesh_colors = false;
            CHECK(draw_materials(*gpu, scene, LinePath::geometry).rgba == blueprint.rgba);
        }
}

// A box whose sides are red and blue: the line between a front and a back has the color of the front.
TEST_CASE("a silhouette has the color of its front face") {
    RIMLINE_OPEN_GPU(gpu);
    MeshSource box = make_built_in_shape("box", 12);
    box.materials.materials = {{.base_color = {1, 0, 0}}, {.base_color = {0, 0, 1}}};
    for (const auto& triangle : box.triangles) {
        float z = 0.0f;
        for (const std::uint32_t v : triangle) z += box.positions[v].z;
        box.materials.of_face.push_back(MaterialId{z > 2.9f ? 0u : 1u});
    }
    const Model model(box);
    for (const double side : {1.0, -1.0}) {
        Scene scene{.camera = {.eye = {0, 0, 5.0 * side}, .ortho_height = 4.0},
                    .style = Style::toon,
                    .palette = {.background = glm::vec3(1.0f)},
                    .shadows = false,
                    .line_width_px = 6.0f};
        scene.instances = {
            {.octree = &model.octree,
             .material = {.shows_mesh_colors = false, .lines_in_mesh_colors = true}}};
        const Picture picture = draw_materials(*gpu, scene, LinePath::geometry);
        // The left side of the square, 20 pixels from the middle.
        const std::size_t x = k_material_width / 2 - 20, y = k_material_height / 2;
        CHECK(channel(picture, x, y, side > 0.0 ? 0 : 2) > 100);
        CHECK(channel(picture, x, y, side > 0.0 ? 2 : 0) == 0);
    }
}

}  // namespace
}  // namespace rimline
