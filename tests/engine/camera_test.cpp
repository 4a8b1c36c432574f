#include "engine/camera.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <initializer_list>

namespace rimline {
namespace {

// Where a point lands: x and y in [-1, 1] with y down, depth reversed.
glm::dvec3 project(const Camera& camera, const Projection& projection, const glm::dvec3& point) {
    const glm::dvec3 eye = camera_from_world(camera) * (point - camera.eye);
    const double w = projection.w[0] * eye.z + projection.w[1];
    return glm::dvec3(glm::dvec2(eye) * projection.scale,
                      projection.z[0] * eye.z + projection.z[1]) /
           w;
}

TEST_CASE("the target lands in the middle, up is up and right is right") {
    for (const double ortho : {0.0, 5.0}) {
        const Camera camera{.eye = {3, 4, 5},
                            .target = {1, 0, -1},
                            .up = {0, 1, 0},
                            .fov_y_deg = 50,
                            .ortho_height = ortho};
        const Projection projection = make_projection(camera, 1.5, {0, 0, 0}, 3.0);
        const glm::dvec3 middle = project(camera, projection, camera.target);
        CHECK(middle.x == doctest::Approx(0.0));
        CHECK(middle.y == doctest::Approx(0.0));
        CHECK(project(camera, projection, camera.target + glm::dvec3(0, 1, 0)).y < -0.1);
        const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
        const glm::dvec3 right = glm::cross(glm::dvec3(0, 1, 0), back);
        CHECK(project(camera, projection, camera.target + right).x > 0.1);
    }
}

TEST_CASE("the edge of the field of view is the edge of the picture") {
    const Camera camera{.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov_y_deg = 90};
    const Projection projection = make_projection(camera, 2.0, {0, 0, 0}, 1.0);
    CHECK(project(camera, projection, {0, 5, 0}).y == doctest::Approx(-1.0));
    CHECK(project(camera, projection, {10, 0, 0}).x == doctest::Approx(1.0));
    const Camera flat{.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}, .ortho_height = 4};
    const Projection flat_projection = make_projection(flat, 2.0, {0, 0, 0}, 1.0);
    CHECK(project(flat, flat_projection, {0, 2, -7}).y == doctest::Approx(-1.0));
    CHECK(project(flat, flat_projection, {4, 0, 0.5}).x == doctest::Approx(1.0));
}

TEST_CASE(
    "depth is reversed: nearer is greater, infinity is zero, all of the scene is within 0 and 1") {
    const Camera camera{.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}};
    const Projection projection = make_projection(camera, 1.0, {0, 0, 0}, 1.0);
    CHECK(project(camera, projection, {0, 0, 1}).z > project(camera, projection, {0, 0, -1}).z);
    CHECK(project(camera, projection, {0, 0, -1e12}).z == doctest::Approx(0.0));
    CHECK(project(camera, projection, {0, 0, 5 - 1e-4}).z == doctest::Approx(1.0));
    // Orthographic: also what lies behind the eye.
    const Camera flat{.eye = {0, 0, 0.1}, .target = {0, 0, 0}, .up = {0, 1, 0}, .ortho_height = 4};
    const Projection flat_projection = make_projection(flat, 1.0, {0, 0, 0}, 1.0);
    const double near = project(flat, flat_projection, {0, 0, 1}).z;
    const double far = project(flat, flat_projection, {0, 0, -1}).z;
    CHECK(near < 1.0);
    CHECK(near > far);
    CHECK(far > 0.0);
}

TEST_CASE("looking along the up axis still gives a rotation") {
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, 0, 1}, {1, 0, 0}, {0, -2, 0}}) {
        const Camera camera{.eye = up * 3.0, .target = {0, 0, 0}, .up = up};
        const glm::dmat3 axes = camera_from_world(camera);
        const glm::dmat3 identity = axes * glm::transpose(axes);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                CHECK(identity[i][j] == doctest::Approx(i == j ? 1.0 : 0.0));
        CHECK(glm::determinant(axes) == doctest::Approx(1.0));
    }
}

}  // namespace
}  // namespace rimline
