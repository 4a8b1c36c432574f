// Lines of another point's silhouette, looked at from where the camera is (Scene::silhouette_camera).

#include <doctest/doctest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"

using namespace rimline;

namespace {

constexpr std::uint32_t k_frozen_silhouette_size = 96;

Scene scene_of(const HoughOctree& octree) {
    Scene scene{.camera = {.eye = {0, 0, 4}, .target = {0, 0, 0}, .up = {0, 1, 0}},
                .shadows = false};
    scene.instances.push_back({.octree = &octree});
    return scene;
}

std::uint32_t edges_from(const HoughOctree& octree, const glm::vec3& eye) {
    std::vector<EdgeId> edges;
    TraversalCounters counters;
    octree.extract(HomogeneousPoint::viewpoint(eye), edges, counters);
    return static_cast<std::uint32_t>(edges.size());
}

// Rows of the sphere's middle in which a line runs within three pixels of the middle column.
std::uint32_t rows_with_line(const Picture& picture) {
    std::uint32_t rows = 0;
    for (std::uint32_t y = k_frozen_silhouette_size / 4; y < 3 * k_frozen_silhouette_size / 4;
         ++y) {
        bool dark = false;
        for (std::uint32_t x = k_frozen_silhouette_size / 2 - 3;
             x < k_frozen_silhouette_size / 2 + 3; ++x)
            dark = dark || picture.rgba[4 * (y * k_frozen_silhouette_size + x)] < 128;
        rows += dark;
    }
    return rows;
}

}  // namespace

TEST_CASE("a frozen silhouette is its own point's, wherever the camera goes, and thaws") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const HoughOctree octree(mesh);
    Scene scene = scene_of(octree);
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    const glm::vec3 from(3.0f, 2.0f, -1.0f);
    const std::uint32_t frozen = edges_from(octree, from);
    scene.silhouette_camera = Camera{.eye = glm::dvec3(from), .target = {0, 0, 0}};
    for (const double angle_deg : {0.0, 40.0, 170.0}) {
        const double angle = glm::radians(angle_deg);
        scene.camera.eye = 4.0 * glm::dvec3(std::sin(angle), 0.2, std::cos(angle));
        renderer.render(scene, k_frozen_silhouette_size, k_frozen_silhouette_size);
        CHECK(renderer.report().silhouette == frozen);
    }
    scene.silhouette_camera.reset();
    renderer.render(scene, k_frozen_silhouette_size, k_frozen_silhouette_size);
    CHECK(renderer.report().silhouette == edges_from(octree, glm::vec3(scene.camera.eye)));
    CHECK(renderer.report().silhouette != frozen);
}

TEST_CASE("a frozen silhouette runs over the surface that faces the camera without gaps") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("sphere", 5000));
    const HoughOctree octree(mesh);
    Scene scene = scene_of(octree);
    Renderer renderer(gpu->context());
    CHECK(rows_with_line(
              renderer.render(scene, k_frozen_silhouette_size, k_frozen_silhouette_size)) == 0);
    // From far to the side: the circle between the camera and the back.
    for (const double side : {-1.0, 1.0}) {
        scene.silhouette_camera = Camera{.eye = {side * 100.0, 0.0, 0.0}, .target = {0, 0, 0}};
        CHECK(rows_with_line(
                  renderer.render(scene, k_frozen_silhouette_size, k_frozen_silhouette_size)) ==
              k_frozen_silhouette_size / 2);
    }
    // The half of it behind the sphere is hidden: seen from the same point, nothing but the outline.
    scene.silhouette_camera = scene.camera;
    CHECK(rows_with_line(
              renderer.render(scene, k_frozen_silhouette_size, k_frozen_silhouette_size)) == 0);
}
