#include "tools/options/shadow_framing.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline::tools {
namespace {

constexpr double k_aspect = 4.0 / 3.0;

// How far from the middle of the picture a point lies: 1 is its border.
double place_in_picture(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec3 p = camera_from_world(camera) * (point - camera.eye);
    REQUIRE(p.z < 0.0);
    const double tangent = std::tan(0.5 * glm::radians(camera.fov_y_deg));
    return std::max(std::abs(p.x) / k_aspect, std::abs(p.y)) / (-p.z * tangent);
}

TEST_CASE("the frame holds the model and its shadow on the ground, and nothing more") {
    const Mesh mesh(make_built_in_shape("spring", 2000));
    const glm::dvec3 up(0, 1, 0);
    const Camera camera =
        fit_camera({.fov_y_deg = 35.0}, mesh, default_view_direction(up), k_aspect);
    double ground = 1e9;
    for (const glm::vec3& p : mesh.positions()) ground = std::min(ground, double{p.y});
    for (const glm::dvec3 sun :
         {glm::dvec3(-1, 1, 0.3), glm::dvec3(1, 1.2, -1), glm::dvec3(0.2, 3, 0.1)}) {
        const Light light{.vector = sun, .directional = true};
        const Camera framed = frame_with_shadows(camera, mesh, {&light, 1}, up, k_aspect);
        CHECK(glm::distance(glm::normalize(framed.eye - framed.target),
                            glm::normalize(camera.eye - camera.target)) < 1e-5);
        double most = 0.0, most_before = 0.0;
        for (const glm::vec3& p : mesh.positions()) {
            const glm::dvec3 shadow = glm::dvec3(p) - (p.y - ground) / sun.y * sun;
            for (const glm::dvec3& point : {glm::dvec3(p), shadow}) {
                most = std::max(most, place_in_picture(framed, point));
                most_before = std::max(most_before, place_in_picture(camera, point));
            }
        }
        CHECK(most < 0.96);
        CHECK(most > 0.9);
        if (sun.y < 3.0) CHECK(most_before > 1.0);
    }
}

TEST_CASE("lamps, and suns that are low or under the ground, do not change the frame") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const glm::dvec3 up(0, 1, 0);
    const Camera camera =
        fit_camera({.fov_y_deg = 35.0}, mesh, default_view_direction(up), k_aspect);
    const std::vector<Light> lights{{.vector = {3, 2, 1}, .directional = false},
                                    {.vector = {1, 0.01, 0}, .directional = true},
                                    {.vector = {1, -1, 0}, .directional = true}};
    const Camera framed = frame_with_shadows(camera, mesh, lights, up, k_aspect);
    CHECK(glm::distance(framed.eye, camera.eye) < 1e-5 * mesh.radius());
    CHECK(glm::distance(framed.target, camera.target) < 1e-5 * mesh.radius());
    // A long shadow is held as far as three radii.
    const Light low{.vector = {1, 0.2, 0}, .directional = true};
    const Camera far = frame_with_shadows(camera, mesh, {&low, 1}, up, k_aspect);
    CHECK(glm::distance(far.eye, mesh.center()) > 1.2 * glm::distance(camera.eye, mesh.center()));
    CHECK(glm::distance(far.eye, mesh.center()) < 4.0 * glm::distance(camera.eye, mesh.center()));
}

}  // namespace
}  // namespace rimline::tools
