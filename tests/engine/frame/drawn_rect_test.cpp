#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "engine/frame/drawn_rect.h"
#include "engine/passes/composite_pass.h"
#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using tests::Model;

glm::vec3 paper(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    return {tests::linear_from_srgb(r), tests::linear_from_srgb(g), tests::linear_from_srgb(b)};
}

// One of many cameras: from within the mesh's box to far away; it may look past the mesh or away.
Camera random_camera(std::mt19937& random, const Mesh& mesh) {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(any(random), any(random), any(random)) + 1e-3);
    };
    const double radii = std::pow(10.0, 0.8 * any(random) + 0.4);
    Camera camera{.eye = mesh.center() + radii * mesh.radius() * direction(),
                  .up = direction(),
                  .fov_y_deg = 45.0 + 30.0 * any(random)};
    camera.target = mesh.center() + 0.7 * radii * mesh.radius() * direction();
    if (random() % 4 == 0) camera.ortho_height = (2.5 + 2.0 * any(random)) * mesh.radius();
    if (random() % 16 == 0) {
        // From afar, at what floats hardly tell apart.
        camera.target = mesh.center();
        camera.eye = mesh.center() + 1e4 * mesh.radius() * direction();
        camera.ortho_height = 0.05 * mesh.radius();
    }
    return camera;
}

struct Models {
    Model knot{make_built_in_shape("knot", 600)};
    Model far_knot{far_from_origin(make_built_in_shape("knot", 600))};
    Model ground{make_ground(knot.mesh, {0, 1, 0}, knot.mesh.radius())};

    static MeshSource far_from_origin(MeshSource source) {
        for (glm::vec3& position : source.positions) position += glm::vec3(3e5f, -5e5f, 2e5f);
        return source;
    }
};

Scene random_scene(std::mt19937& random, const Models& models, Style style) {
    const Model& model = random() % 4 == 0 ? models.far_knot : models.knot;
    const glm::vec3 background = paper(240, 235, 225);
    Scene scene{.camera = random_camera(random, model.mesh),
                .style = style,
                .palette = default_palette(style, background)};
    scene.line_width_px = random() % 2 == 0 ? 2.0f : 11.0f;
    scene.hidden_line_strength = 0.5f;
    scene.crease_angle_deg = random() % 2 == 0 ? 0.0f : 20.0f;
    scene.palette.grid_strength = 0.0f;
    scene.instances.push_back(
        {.octree = &model.octree, .material = {.color = default_surface_color(style, background)}});
    if (random() % 2 == 0) {
        scene.instances.push_back(scene.instances[0]);
        scene.instances[1].translation = 1.5 * model.mesh.radius() * glm::dvec3(1.0, 0.2, -0.4);
        scene.instances[1].material.line_color = glm::vec3(0.5f, 0.1f, 0.0f);
    }
    if (random() % 4 == 0) {
        const double angle = 0.1 * double(random() % 60);
        SceneInstance& turned = scene.instances.back();
        turned.rotation = {std::cos(angle),
                           std::sin(angle),
                           0.0,
                           -std::sin(angle),
                           std::cos(angle),
                           0.0,
                           0.0,
                           0.0,
                           1.0};
    }
    if (random() % 4 == 0) {
        SceneInstance& waving = scene.instances.back();
        waving.octree = nullptr;
        waving.deforming = &model.mesh;
        waving.deformation = default_wave(model.mesh, {0, 1, 0}, 0.6);
    }
    if (random() % 8 == 0)
        scene.instances.push_back({.octree = &models.ground.octree,
                                   .has_lines = false,
                                   .fade_radius = 6.0 * model.mesh.radius(),
                                   .fade_center = model.mesh.center()});
    if (random() % 8 == 0) scene.silhouette_camera = random_camera(random, model.mesh);
    scene.shadows = random() % 4 != 0;
    scene.lights.push_back(default_sun(scene.camera));
    return scene;
}

// As a renderer makes it.
FrameView view_of(const Scene& scene, VkExtent2D size) {
    CasterMeshes casters;
    for (const SceneInstance& instance : scene.instances)
        if (!instance.deforming) casters.try_emplace(&instance.mesh(), instance.mesh());
    return FrameView(scene, size, casters);
}

TEST_CASE("a picture drawn where its scene is equals one drawn everywhere" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Models models;
    Renderer plain(gpu->context(), {.samples = 1, .scale = 1});
    Renderer fine(gpu->context(), {.samples = 4, .scale = 2});
    std::mt19937 random(20261123);
    std::size_t drawn_in_part = 0;
    std::size_t in_sight = 0;
    for (int number = 0; number < 200; ++number) {
        constexpr std::uint32_t k_width = 90;
        constexpr std::uint32_t k_height = 70;
        const Style style = number % 3 == 0 ? Style::hatch : Style::ink;
        Scene scene = random_scene(random, models, style);
        Renderer& renderer = number % 2 == 0 ? plain : fine;
        const Picture in_part = renderer.render(scene, k_width, k_height);
        scene.palette.grid_strength = 1e-30f;  // Drawn everywhere, and seen nowhere.
        const Picture everywhere = renderer.render(scene, k_width, k_height);
        CAPTURE(number);
        CHECK(in_part.rgba == everywhere.rgba);
        const VkRect2D rect = drawn_rect(view_of(scene, {k_width, k_height}));
        if (rect.extent.width * rect.extent.height < k_width * k_height) ++drawn_in_part;
        std::size_t inked = 0;
        for (std::size_t i = 0; i < everywhere.rgba.size(); i += 4) {
            if (everywhere.rgba[i] == 240 && everywhere.rgba[i + 2] == 225) continue;
            ++inked;
            const auto x = static_cast<std::int32_t>(i / 4 % k_width) - rect.offset.x;
            const auto y = static_cast<std::int32_t>(i / 4 / k_width) - rect.offset.y;
            CHECK((x >= 0 && x < std::int32_t(rect.extent.width) && y >= 0 &&
                   y < std::int32_t(rect.extent.height)));
        }
        if (inked > 0) ++in_sight;
    }
    CHECK(drawn_in_part > 60);
    CHECK(in_sight > 100);
}

TEST_CASE("the rectangle that a scene is drawn in is around it and no larger") {
    const Model model(make_built_in_shape("box", 12));
    const double radius = model.mesh.radius();
    const glm::dvec3 middle = model.mesh.center();
    Scene scene{.camera = {.eye = middle + glm::dvec3(0, 0, 20.0 * radius),
                           .target = middle,
                           .fov_y_deg = 40.0}};
    const VkExtent2D size{1000, 500};
    VkRect2D rect = drawn_rect(view_of(scene, size));
    CHECK((rect.extent.width == 1 && rect.extent.height == 1));
    scene.instances.push_back({.octree = &model.octree});
    rect = drawn_rect(view_of(scene, size));
    // A sphere around it is 2 * 500 / (2 tan 20 deg) / 20 = 68.7 pixels wide.
    CHECK(rect.extent.width < 68 + 20);
    CHECK(rect.extent.height < 68 + 20);
    CHECK(std::abs(rect.offset.x + int(rect.extent.width) / 2 - 500) <= 1);
    CHECK(std::abs(rect.offset.y + int(rect.extent.height) / 2 - 250) <= 1);
    // Behind the camera nothing is seen; around it anything may be.
    scene.camera.target = middle + glm::dvec3(0, 0, 40.0 * radius);
    rect = drawn_rect(view_of(scene, size));
    CHECK((rect.extent.width == 1 && rect.extent.height == 1));
    scene.camera.eye = middle;
    rect = drawn_rect(view_of(scene, size));
    CHECK((rect.extent.width == size.width && rect.extent.height == size.height));
    // What is beside the picture leaves it empty.
    scene.camera = {.eye = middle + glm::dvec3(0, 0, 20.0 * radius),
                    .target = middle + glm::dvec3(200.0 * radius, 0, 0)};
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].translation = {-500.0 * radius, 0, 0};
    rect = drawn_rect(view_of(scene, size));
    CHECK((rect.extent.width == 1 && rect.extent.height == 1));
    for (const VkExtent2D tiny : {VkExtent2D{1, 1}, VkExtent2D{3, 1}}) {
        rect = drawn_rect(view_of(scene, tiny));
        CHECK(rect.offset.x + rect.extent.width <= tiny.width);
        CHECK(rect.offset.y + rect.extent.height <= tiny.height);
    }
}

TEST_CASE("far from the origin the rectangle is where the GPU, which has floats, draws") {
    MeshSource source = make_built_in_shape("knot", 600);
    for (glm::vec3& position : source.positions) position += glm::vec3(3e5f, -5e5f, 2e5f);
    const Model model(source);
    const glm::dvec3 middle = model.mesh.center();
    const VkExtent2D size{4000, 4000};
    int moved = 0;
    for (int number = 0; number < 20; ++number) {
        Scene scene{
            .camera = {.eye = middle + model.mesh.radius() * glm::dvec3(2.0, 0.3, 0.1 * number),
                       .target = middle}};
        scene.instances.push_back({.octree = &model.octree});
        const VkRect2D rect = drawn_rect(view_of(scene, size));
        const glm::dvec3 eye(glm::vec3(scene.camera.eye));
        scene.camera.target += eye - scene.camera.eye;
        if (glm::distance(eye, scene.camera.eye) > 1e-3) ++moved;
        scene.camera.eye = eye;
        const VkRect2D rounded = drawn_rect(view_of(scene, size));
        CHECK(std::abs(rect.offset.x - rounded.offset.x) <= 1);
        CHECK(std::abs(rect.offset.y - rounded.offset.y) <= 1);
    }
    CHECK(moved > 0);
}

TEST_CASE("paper around a scene is told only where its value is beyond doubt") {
    const std::optional<VkClearColorValue> told =
        composite_of(paper(0, 128, 255), VK_FORMAT_R8G8B8A8_UNORM);
    REQUIRE(told);
    CHECK(told->float32[0] == 0.0f);
    CHECK(told->float32[1] == doctest::Approx(128.0 / 255.0).epsilon(1e-7));
    CHECK(told->float32[2] == 1.0f);
    CHECK(told->float32[3] == 1.0f);
    CHECK_FALSE(composite_of(paper(0, 128, 255), VK_FORMAT_R16G16B16A16_SFLOAT));
    CHECK_FALSE(composite_of(paper(0, 128, 255), VK_FORMAT_R8G8B8A8_SRGB));
    const glm::vec3 between = 0.5f * (paper(0, 128, 255) + paper(0, 129, 255));
    CHECK_FALSE(composite_of(between, VK_FORMAT_B8G8R8A8_UNORM));
}

}  // namespace
}  // namespace rimline
