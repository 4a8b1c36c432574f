#include "silhouette/field/picture_view.h"

#include <doctest/doctest.h>

#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <stop_token>

#include "silhouette/mesh/ground_axes.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

// A square across z, of this side, with its middle on the z axis.
void add_square(MeshSource& source, float side, float z) {
    const auto first = static_cast<std::uint32_t>(source.positions.size());
    for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        source.positions.emplace_back(0.5f * side * corner, z);
    source.triangles.push_back({first, first + 1, first + 2});
    source.triangles.push_back({first, first + 2, first + 3});
}

TEST_CASE("the visible share of borders is that of the closed form") {
    MeshSource source;
    add_square(source, 2.0f, 0.0f);
    const std::array<glm::dvec3, 2> both{{{0, 0, 1}, {0, 0, -1}}};
    for (const Shown& shown : measure_shown(Mesh(source), both)) {
        CHECK(shown.visible_share == 1.0);
        CHECK(shown.area == doctest::Approx(2.0 / std::numbers::pi).epsilon(0.03));
    }
    // A smaller square of half the side behind: 8 of 12 units of border are seen from the front, all from behind.
    add_square(source, 1.0f, -0.5f);
    const std::vector<Shown> shown = measure_shown(Mesh(source), both);
    CHECK(shown[0].visible_share == doctest::Approx(8.0 / 12.0).epsilon(0.02));
    CHECK(shown[1].visible_share == 1.0);
    CHECK(measure_shown(Mesh(MeshSource{}), both)[0].visible_share == 1.0);
}

TEST_CASE("all of a convex solid's silhouette is visible") {
    const Mesh sphere(make_built_in_shape("sphere", 5000));
    const std::array<glm::dvec3, 3> directions{{{0, 0, 1}, {1, 2, 3}, {-1, 0.2, 0}}};
    for (const Shown& shown : measure_shown(sphere, directions)) {
        CHECK(shown.visible_share > 0.99);
        CHECK(shown.area == doctest::Approx(1.0).epsilon(0.03));
    }
}

TEST_CASE("the direction of a picture has length 1 and looks down a little") {
    for (const std::string_view name : k_built_in_shapes)
        for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, 0, 1}, {-1, 0, 0}, {1, 2, 3}}) {
            CAPTURE(name);
            const Mesh mesh(make_built_in_shape(name, 2000));
            const glm::dvec3 direction = choose_picture_direction(mesh, up);
            CHECK(glm::length(direction) == doctest::Approx(1.0));
            const double height = glm::degrees(std::asin(glm::dot(direction, glm::normalize(up))));
            CHECK(height > 7.9);
            CHECK(height < 45.1);
        }
}

TEST_CASE("a mesh without planes is seen from the three-quarter view") {
    const glm::dvec3 up(0, 1, 0);
    CHECK(choose_picture_direction(Mesh(MeshSource{}), up) == three_quarter_direction(up));
    const Mesh needle(
        MeshSource{.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, .triangles = {{0, 1, 2}}});
    CHECK(choose_picture_direction(needle, up) == three_quarter_direction(up));
}

TEST_CASE("an upright plate is seen from one of its faces and not along its plane") {
    MeshSource source = make_built_in_shape("box", 12);
    for (glm::vec3& p : source.positions) p.x *= 0.02f;
    const glm::dvec3 direction = choose_picture_direction(Mesh(source), {0, 1, 0});
    CHECK(std::abs(direction.x) > 0.5);
}

TEST_CASE("a box is seen with three faces") {
    for (const glm::vec3 size : {glm::vec3(1, 1, 1), {4, 1, 2}, {1, 2, 1}}) {
        CAPTURE(size.x);
        MeshSource source = make_built_in_shape("box", 12);
        for (glm::vec3& p : source.positions) p *= size;
        const glm::dvec3 direction = choose_picture_direction(Mesh(source), {0, 1, 0});
        for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(direction[axis]) > 0.3);
    }
}

TEST_CASE("the direction turns with the mesh's place, size and threads unchanged") {
    MeshSource source = make_built_in_shape("knot", 4000);
    const glm::dvec3 direction = choose_picture_direction(Mesh(source), {0, 1, 0});
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(choose_picture_direction(Mesh(source), {0, 1, 0}) == direction);
    }
    for (glm::vec3& p : source.positions) p = 1024.0f * p;
    CHECK(glm::distance(choose_picture_direction(Mesh(source), {0, 1, 0}), direction) < 1e-6);
    // y to z.
    for (glm::vec3& p : source.positions) p = {p.x, -p.z, p.y};
    const glm::dvec3 turned = choose_picture_direction(Mesh(source), {0, 0, 1});
    CHECK(glm::distance(turned, {direction.x, -direction.z, direction.y}) < 1e-6);
}

TEST_CASE("choosing a direction is cancelled") {
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(choose_picture_direction(Mesh(make_built_in_shape("knot", 2000)), {0, 1, 0},
                                             {stop.get_token(), {}}),
                    Error);
    const glm::dvec3 direction(1, 0, 0);
    CHECK_THROWS_AS(
        measure_shown(Mesh(make_built_in_shape("knot", 2000)), {&direction, 1}, stop.get_token()),
        Error);
}

}  // namespace
}  // namespace rimline
