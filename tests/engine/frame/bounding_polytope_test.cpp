#include "engine/frame/bounding_polytope.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <vector>

#include "engine/frame/drawn_rect.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using tests::Model;

// How far points reach along a direction.
template <typename Points>
double reach(const Points& points, const glm::dvec3& direction) {
    double reach = -1e300;
    for (const auto& point : points)
        reach = std::max(reach, glm::dot(direction, glm::dvec3(point)));
    return reach;
}

glm::dvec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> any;
    return glm::normalize(glm::dvec3(any(random), any(random), any(random)));
}

std::vector<glm::vec3> points_on_sphere(std::size_t count) {
    std::mt19937 random(20261127);
    std::vector<glm::vec3> points;
    while (points.size() < count) points.emplace_back(random_direction(random));
    return points;
}

std::vector<glm::vec3> moved(std::vector<glm::vec3> points, const glm::vec3& scale,
                             const glm::vec3& by) {
    for (glm::vec3& point : points) point = scale * point + by;
    return points;
}

// Convex sets contain each other if they reach as far in all directions.
void check_contains(const std::vector<glm::vec3>& points) {
    const std::vector<glm::dvec3> corners = polytope_around(points);
    CHECK(corners.size() >= 4);
    CHECK(corners.size() <= 96);
    std::mt19937 random(1);
    for (int number = 0; number < 500; ++number) {
        const glm::dvec3 direction = random_direction(random);
        CHECK(reach(corners, direction) >= reach(points, direction));
    }
}

TEST_CASE("the polytope around points contains them") {
    CHECK(polytope_around({}).empty());
    const std::vector<glm::vec3> sphere = points_on_sphere(300);
    check_contains(sphere);
    check_contains(make_built_in_shape("knot", 600).positions);
    check_contains(make_built_in_shape("box", 12).positions);
    check_contains(moved(sphere, {1.0f, 40.0f, 1e-4f}, {}));
    check_contains(moved(sphere, glm::vec3(1e-3f), {3e5f, -5e5f, 2e5f}));
    check_contains(moved(sphere, glm::vec3(1e30f), {}));
    check_contains(moved(sphere, glm::vec3(1e-30f), {}));
    // Flat, a line, a point.
    check_contains(moved(sphere, {1.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 7.0f}));
    check_contains(moved(sphere, {0.0f, 1.0f, 0.0f}, {1.0f, 0.0f, -3.0f}));
    check_contains({glm::vec3(2.0f, -3.0f, 5.0f)});
    check_contains({{0, 0, 0}, {1, 2, 3}, {-4, 1, 1}});
}

TEST_CASE("the polytope around points is close to them") {
    const std::vector<glm::vec3> sphere = points_on_sphere(3000);
    std::mt19937 random(2);
    double sum = 0.0;
    for (const glm::vec3& scale : {glm::vec3(1.0f), glm::vec3(1.0f, 3.0f, 0.2f)}) {
        const std::vector<glm::vec3> points = moved(sphere, scale, {0.3f, 0.0f, -2.0f});
        const std::vector<glm::dvec3> corners = polytope_around(points);
        for (int number = 0; number < 200; ++number) {
            const glm::dvec3 direction = random_direction(random);
            const double wide = reach(corners, direction) + reach(corners, -direction);
            const double needed = reach(points, direction) + reach(points, -direction);
            CHECK(wide < 1.18 * needed);  // A box is up to 1.73 times as wide.
            sum += wide / needed / 400.0;
        }
    }
    CHECK(sum < 1.08);
    // Of a box it is the box.
    const std::vector<glm::vec3> box = make_built_in_shape("box", 12).positions;
    const std::vector<glm::dvec3> corners = polytope_around(box);
    for (const glm::dvec3& corner : corners)
        CHECK(std::ranges::any_of(box, [&](const glm::vec3& point) {
            return glm::distance(corner, glm::dvec3(point)) < 1e-7;
        }));
}

TEST_CASE("a round scene is drawn in a rectangle smaller than that around its box") {
    const Model sphere(make_built_in_shape("sphere", 2000));
    const glm::dvec3 middle = sphere.mesh.center();
    const double radius = sphere.mesh.radius();
    Scene scene{.instances = {{.octree = &sphere.octree}},
                .camera = {.eye = middle + radius * glm::dvec3(3.0, 2.5, 3.5), .target = middle}};
    const VkExtent2D size{2000, 2000};
    const VkRect2D around_box = drawn_rect(FrameView(scene, size, {}));
    CasterMeshes casters;
    casters.try_emplace(&sphere.mesh, sphere.mesh);
    const VkRect2D rect = drawn_rect(FrameView(scene, size, casters));
    CHECK(rect.extent.width < 0.8 * around_box.extent.width);
    CHECK(rect.extent.height < 0.8 * around_box.extent.height);
    // All of it, seen under the angle whose sine is a radius over the distance.
    const double distance = glm::distance(scene.camera.eye, middle);
    const double half_px = 1000.0 / std::tan(glm::radians(0.5 * scene.camera.fov_y_deg)) /
                           std::sqrt(distance * distance / (radius * radius) - 1.0);
    CHECK(rect.extent.width >= 1.98 * half_px);
    CHECK(rect.extent.width <= 2.3 * half_px);
}

}  // namespace
}  // namespace rimline
