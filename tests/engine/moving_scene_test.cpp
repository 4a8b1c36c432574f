// Everything moves at once, and every frame is what a renderer draws that has never drawn another.

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/rounds.h"

namespace rimline {
namespace {

using namespace rimline::tests;

struct Stock {
    Model knot{make_built_in_shape("knot", 1500)};
    Model spring{make_built_in_shape("spring", 1500)};
    Model ground{[this] { return make_ground(knot.mesh, {0, 1, 0}, 6.0 * knot.mesh.radius()); }()};
};

// Three knots and two springs over a ground, a sun and two lamps: at time `t` none is where it was.
Scene scene_at(const Stock& stock, Style style, double t) {
    const double radius = stock.knot.mesh.radius();
    Scene scene{.camera = {.eye = glm::dvec3(4.5 * std::sin(0.3 * t), 2.5 + 0.4 * t,
                                             4.5 * std::cos(0.3 * t)) *
                                  radius,
                           .target = glm::dvec3(0.1 * t, 0.0, 0.0)},
                .style = style,
                .palette = default_palette(style, style_defaults(style).background),
                .hidden_line_strength = 0.4f,
                .crease_angle_deg = 40.0f};
    for (int i = 0; i < 5; ++i) {
        const Model& model = i % 2 == 0 ? stock.knot : stock.spring;
        const double angle = 0.9 * i + (i % 2 == 0 ? 0.11 : -0.07) * t;
        SceneInstance instance{
            .octree = &model.octree,
            .rotation = glm::dmat3(
                glm::rotate(glm::dmat4(1.0), angle, glm::normalize(glm::dvec3(0.2 * i, 1, 0.3)))),
            .translation = glm::dvec3(std::cos(1.25 * i + 0.05 * t), 0.3 + 0.08 * i,
                                      std::sin(1.25 * i + 0.05 * t)) *
                           (1.6 * radius),
            .material = {.color = {0.8f, 0.2f * float(i), 0.3f}}};
        if (i % 2 == 1) instance.material.line_color = glm::vec3(0.0f, 0.1f, 0.5f);
        scene.instances.push_back(instance);
    }
    scene.instances.push_back({.octree = &stock.ground.octree,
                               .translation = {0, -1.0 - 0.02 * t, 0},
                               .has_lines = false,
                               .casts_shadows = false});
    scene.lights = {
        {.vector = {std::cos(0.2 * t), 1.5, std::sin(0.2 * t)}, .directional = true},
        {.vector = glm::dvec3(2.0 - 0.1 * t, 3.0, 2.0) * radius, .directional = false},
        {.vector = glm::dvec3(-2.0, 2.0 + 0.1 * t, 0.3 * t) * radius, .directional = false}};
    return scene;
}

TEST_CASE("camera lights and instances that all move at once draw what a fresh renderer draws") {
    RIMLINE_OPEN_GPU(gpu);
    const Stock stock;
    constexpr RendererOptions k_options{.samples = 1, .scale = 1};
    for (const Style style : {Style::toon, Style::hatch}) {
        Renderer moving(gpu->context(), k_options);
        Picture before;
        for (int frame = 0; frame < tests::rounds(8); ++frame) {
            CAPTURE(static_cast<int>(style));
            CAPTURE(frame);
            const Scene scene = scene_at(stock, style, frame);
            moving.submit(scene, 160, 120);
            moving.announce(scene_at(stock, style, frame + 1));
            const Picture picture = moving.finish();
            if (frame == 0) save_picture("moving_scene", picture, {});
            Renderer fresh(gpu->context(), k_options);
            CHECK(fresh.render(scene, 160, 120).rgba == picture.rgba);
            CHECK(picture.rgba != before.rgba);
            if (frame > 0) CHECK(moving.report().bytes_streamed < moving.report().bytes_full);
            before = picture;
        }
    }
}

TEST_CASE("a mesh is uploaded once for all its instances and frames") {
    RIMLINE_OPEN_GPU(gpu);
    const Stock stock;
    const Model box(make_built_in_shape("box", 12));
    for (const LinePath path : {LinePath::geometry, LinePath::adjacency}) {
        CAPTURE(static_cast<int>(path));
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1, .line_path = path});
        Scene scene = scene_at(stock, Style::toon, 0.0);
        renderer.render(scene, 32, 32);
        CHECK(renderer.report().meshes_uploaded == 3);
        const std::uint64_t three = renderer.report().bytes_uploaded;
        // At least positions, corners and normals.
        const auto least = [](const Mesh& mesh) {
            return 12u * mesh.vertex_count() + 48u * mesh.face_count();
        };
        CHECK(three > least(stock.knot.mesh) + least(stock.spring.mesh) + least(stock.ground.mesh));
        for (int frame = 1; frame < 5; ++frame) {
            scene = scene_at(stock, Style::toon, frame);
            for (int i = 0; i < frame; ++i) scene.instances.push_back(scene.instances[1]);
            renderer.render(scene, 32, 32);
            CHECK(renderer.report().meshes_uploaded == 0);
            CHECK(renderer.report().bytes_uploaded == 0);
        }
        scene.instances.push_back({.octree = &box.octree});
        scene.instances.push_back({.octree = &box.octree, .translation = {1, 1, 1}});
        renderer.render(scene, 32, 32);
        CHECK(renderer.report().meshes_uploaded == 1);
        CHECK(renderer.report().bytes_uploaded < three / 10);
        // One that has gone is uploaded again.
        scene.instances.resize(scene.instances.size() - 2);
        for (int frame = 0; frame < 3; ++frame) renderer.render(scene, 32, 32);
        scene.instances.push_back({.octree = &box.octree});
        renderer.render(scene, 32, 32);
        CHECK(renderer.report().meshes_uploaded == 1);
    }
}

}  // namespace
}  // namespace rimline
