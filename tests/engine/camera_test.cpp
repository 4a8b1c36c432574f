#include "engine/camera.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <initializer_list>

#include "silhouette/error.h"

namespace rimline {
namespace {

// Where a point lands: x and y in [-1, 1] with y down, depth reversed.
glm::dvec3 project(const Camera& camera, const Projection& projection, const glm::dvec3& point) {
    const glm::dvec3 eye = camera_from_world(camera) * (point - camera.eye);
    const double w = projection.w[0] * eye.z + projection.w[1];
    return glm::dvec3(glm::dvec2(eye) * projection.scale + projection.shift * w,
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

TEST_CASE(
    "the near plane of another renderer's parallel projection clips as its perspective's does") {
    for (const bool reversed : {false, true}) {
        // Depth of eye.z = -2 and of eye.z = -12.
        const glm::dvec2 depths = reversed ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0, 1.0);
        const double slope = (depths[0] - depths[1]) / 10.0;
        const Projection host{
            .scale = {0.5, -0.5}, .z = {slope, depths[0] + 2.0 * slope}, .w = {0.0, 1.0}};
        const Camera camera{
            .eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}, .projection = host};
        // It is at z = 3: within the scene, before it, and behind it.
        for (const double radius : {4.0, 1.0}) {
            const Projection projection = make_projection(camera, 1.0, {0, 0, 0}, radius);
            CHECK(project(camera, projection, {0, 0, std::min(2.99, radius)}).z < 1.0);
            CHECK(project(camera, projection, {0, 0, -radius}).z > 0.0);
            if (radius == 4.0) CHECK(project(camera, projection, {0, 0, 3.01}).z > 1.0);
        }
        const Projection behind = make_projection(camera, 1.0, {0, 0, 9}, 1.0);
        CHECK(project(camera, behind, {0, 0, 8}).z > 1.0);
        CHECK(std::isfinite(behind.z[0]));
        CHECK(behind.z[0] > 0.0);
    }
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

TEST_CASE("a camera of another renderer's matrices sees what the matrices show") {
    const glm::dmat4 view =
        glm::lookAt(glm::dvec3(3, 4, 5), glm::dvec3(1, 0, -1), glm::dvec3(0.1, 1, 0));
    // Rows: x, y, depth, w. Off the axis; depth 0 near and far; 1 near and no far plane; parallel.
    const std::array<glm::dmat4, 3> by_rows{
        {{{1.4, 0, 0.2, 0}, {0, -2.1, -0.1, 0}, {0, 0, -1.01, -0.101}, {0, 0, -1, 0}},
         {{1.4, 0, 0, 0}, {0, -2.1, 0.3, 0}, {0, 0, 0, 0.25}, {0, 0, -1, 0}},
         {{0.3, 0, 0, 0.2}, {0, -0.4, 0, -0.1}, {0, 0, -0.05, -0.1}, {0, 0, 0, 1}}}};
    for (const glm::dmat4& rows : by_rows) {
        const glm::dmat4 matrix = glm::transpose(rows);
        const Camera camera = camera_of(view, matrix);
        const Projection& projection = camera.projection.value();
        const Projection drawn = make_projection(camera, 1.5, {0, 0, 0}, 3.0);
        CHECK(camera.is_orthographic() == (rows[3][3] == 1.0));
        for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), {1, 0.5, -1}, {-0.7, 0.2, 0.9}}) {
            const glm::dvec4 clip = matrix * view * glm::dvec4(point, 1.0);
            const glm::dvec3 shown = project(camera, projection, point);
            for (int axis = 0; axis < 3; ++axis)
                CHECK(shown[axis] == doctest::Approx(clip[axis] / clip.w));
            // What is drawn has the depths of Rimline, at the same places.
            const glm::dvec3 place = project(camera, drawn, point);
            CHECK(place.x == doctest::Approx(shown.x));
            CHECK(place.y == doctest::Approx(shown.y));
            CHECK(place.z > 0.0);
            CHECK(place.z < 1.0);
        }
    }
    // The near plane is that of the matrix.
    const double near = make_projection(camera_of(view, glm::transpose(by_rows[0])), 1, {}, 3).z[1];
    CHECK(near == doctest::Approx(0.1));
}

TEST_CASE("matrices that no camera of ours has are refused with the reason") {
    const glm::dmat4 good{{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 0, -1}, {0, 0, 0.1, 0}};
    CHECK_NOTHROW((void)projection_of(good));
    const auto refused = [&](int row, int column, double value, const char* why) {
        glm::dmat4 matrix = good;
        matrix[column][row] = value;
        CHECK_THROWS_WITH_AS((void)projection_of(matrix), doctest::Contains(why), Error);
    };
    refused(0, 0, -1.0, "mirrors");
    refused(1, 1, 1.0, "mirrors");
    refused(0, 1, 0.1, "turns or skews");
    refused(3, 0, 0.1, "turns or skews");
    refused(0, 3, 0.1, "skews");
    refused(3, 2, 1.0, "does not look along -z");
    refused(3, 3, 1.0, "does not look along -z");
    refused(2, 3, 0.0, "no near plane");
    refused(2, 3, std::nan(""), "not finite");
    glm::dmat4 view(1.0);
    CHECK_NOTHROW((void)camera_of(view, good));
    view[0][0] = 1.1;
    CHECK_THROWS_AS((void)camera_of(view, good), Error);
    view[0][0] = -1.0;
    CHECK_THROWS_AS((void)camera_of(view, good), Error);
}

}  // namespace
}  // namespace rimline
