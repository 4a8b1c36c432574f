#include "engine/view_defaults.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

// The greatest |x| and |y| of all vertices on the screen.
glm::dvec2 extent_on_screen(const Camera& camera, const Mesh& mesh, double aspect) {
    const Projection projection = make_projection(camera, aspect, mesh.center(), mesh.radius());
    glm::dvec2 extent(0.0);
    for (const glm::vec3& position : mesh.positions()) {
        const glm::dvec3 eye = camera_from_world(camera) * (glm::dvec3(position) - camera.eye);
        const double w = projection.w[0] * eye.z + projection.w[1];
        extent = glm::max(extent, glm::abs(glm::dvec2(eye) * projection.scale / w));
    }
    return extent;
}

TEST_CASE("a fitted perspective camera holds every vertex with the margin, and no more") {
    for (const std::string_view name : k_built_in_shapes)
        for (const double aspect : {0.5, 1.0, 1.7})
            for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, 0, 1}}) {
                CAPTURE(name);
                CAPTURE(aspect);
                const Mesh mesh(make_built_in_shape(name, 2000));
                const Camera camera = fit_camera({.up = up, .fov_y_deg = 35}, mesh,
                                                 default_view_direction(up), aspect);
                const glm::dvec2 extent = extent_on_screen(camera, mesh, aspect);
                CHECK(std::max(extent.x, extent.y) == doctest::Approx(1.0 / 1.06).epsilon(1e-6));
            }
}

TEST_CASE("a zoomed camera stays where it is and holds every vertex with the margin") {
    for (const std::string_view name : k_built_in_shapes)
        for (const double aspect : {0.5, 1.0, 1.7})
            for (const glm::dvec3 direction : {glm::dvec3(1, 0.3, 0.2), {0, 1, 0}, {-1, -1, 2}}) {
                CAPTURE(name);
                CAPTURE(aspect);
                const Mesh mesh(make_built_in_shape(name, 2000));
                const glm::dvec3 eye =
                    mesh.center() + 1.75 * mesh.radius() * glm::normalize(direction);
                const Camera camera = zoom_camera({.eye = eye, .up = {0, 1, 0}}, mesh, aspect);
                CHECK(camera.eye == eye);
                const glm::dvec2 extent = extent_on_screen(camera, mesh, aspect);
                CHECK(std::max(extent.x, extent.y) == doctest::Approx(1.0 / 1.06).epsilon(1e-6));
                // In the middle: nothing is farther out on the one side than on the other.
                const Projection projection =
                    make_projection(camera, aspect, mesh.center(), mesh.radius());
                glm::dvec2 low(1.0), high(-1.0);
                for (const glm::vec3& position : mesh.positions()) {
                    const glm::dvec3 p =
                        camera_from_world(camera) * (glm::dvec3(position) - camera.eye);
                    const double w = projection.w[0] * p.z + projection.w[1];
                    low = glm::min(low, glm::dvec2(p) * projection.scale / w);
                    high = glm::max(high, glm::dvec2(p) * projection.scale / w);
                }
                CHECK(glm::length(low + high) < 0.02);
            }
}

TEST_CASE("a camera zoomed on a single point looks at it") {
    const Mesh point(MeshSource{.positions = {{1, 2, 3}}, .triangles = {{0, 0, 0}}});
    const Camera camera = zoom_camera({.eye = {1, 2, 5}}, point, 1.0);
    CHECK(camera.target == glm::dvec3(1, 2, 3));
    CHECK(camera.fov_y_deg == 1.0);
}

TEST_CASE("a needle that points at the viewer lies wholly in front of the camera") {
    const Mesh needle(MeshSource{.positions = {{0, 0, 1}, {1e-5f, 0, -1}, {-1e-5f, 0, -1}},
                                 .triangles = {{0, 1, 2}}});
    const Camera camera = fit_camera({}, needle, {0, 0, 1}, 1.0);
    CHECK(camera.eye.z > 1.01);
}

TEST_CASE("an empty mesh and a single point still give a camera") {
    const Mesh empty{MeshSource{}};
    const Camera camera = fit_camera({}, empty, {0, 0, 1}, 1.0);
    CHECK(camera.eye != camera.target);
    const Mesh point(MeshSource{.positions = {{1, 2, 3}}, .triangles = {{0, 0, 0}}});
    const Camera at_point = fit_camera({}, point, {0, 0, 1}, 1.0);
    CHECK(at_point.eye != at_point.target);
    CHECK(std::isfinite(at_point.eye.x));
}

TEST_CASE("the ground lies under every vertex and faces up") {
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, 0, 1}, {-1, 0, 0}, {1, 2, 3}}) {
        const Mesh mesh(make_built_in_shape("knot", 2000));
        const Mesh ground(make_ground(mesh, up, 8.0 * mesh.radius()));
        const glm::dvec3 n = glm::normalize(up);
        const double height = glm::dot(glm::dvec3(ground.positions()[0]), n);
        for (const glm::vec3& position : mesh.positions())
            REQUIRE(glm::dot(glm::dvec3(position), n) > height);
        for (const Plane& plane : ground.planes())
            CHECK(glm::dot(plane.normal(), n) == doctest::Approx(1.0));
    }
}

TEST_CASE("the ground lies under a flat base far from the origin, after rounding to float") {
    for (const float offset : {1e3f, 1e6f, 4e6f}) {
        CAPTURE(offset);
        MeshSource box = make_built_in_shape("box", 12);
        for (glm::vec3& position : box.positions)
            position = position * 100.0f + glm::vec3(0, offset, 0);
        const Mesh mesh(box);
        const Mesh ground(make_ground(mesh, {0, 1, 0}, 8.0 * mesh.radius()));
        CHECK(ground.bounds().high.y < mesh.bounds().low.y);
    }
}

TEST_CASE("the default sun stands above the horizon and on the viewer's side") {
    const Camera camera{.eye = {3, 2, 4}, .target = {0, 0, 0}, .up = {0, 1, 0}};
    const Light sun = default_sun(camera);
    CHECK(sun.directional);
    CHECK(glm::normalize(sun.vector).y > 0.3);
    CHECK(glm::dot(sun.vector, camera.eye) > 0.0);
}

}  // namespace
}  // namespace rimline
