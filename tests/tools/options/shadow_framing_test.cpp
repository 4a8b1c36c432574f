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

TEST_CASE("the frame holds no shadows for who is below the ground") {
    const Mesh mesh(make_built_in_shape("spring", 2000));
    const glm::dvec3 up(0, 1, 0);
    const Light light{.vector = {-1, 1, 0.3}, .directional = true};
    const Camera below = fit_camera({.fov_y_deg = 35.0}, mesh, {1, -1, 1}, k_aspect);
    CHECK(frame_with_shadows(below, mesh, {&light, 1}, up, k_aspect).eye == below.eye);
    CHECK(zoom_with_shadows(below, mesh, {&light, 1}, up, k_aspect).target == below.target);
    CHECK(tangent_for_shadows(std::vector<Shot>{{below, {light}}}, mesh, up, k_aspect) == 0.0);
    const Camera above = fit_camera({.fov_y_deg = 35.0}, mesh, {1, 1, 1}, k_aspect);
    CHECK(frame_with_shadows(above, mesh, {&light, 1}, up, k_aspect).eye != above.eye);
}

TEST_CASE("a given eye without a target sees the model and its shadow from there") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const glm::dvec3 sun(-1, 1, 0.3);
    const Camera camera{.eye = {2.5, 2, 4}, .target = mesh.center(), .fov_y_deg = 35.0};
    double ground = 1e9;
    for (const glm::vec3& p : mesh.positions()) ground = std::min(ground, double{p.y});
    const auto most = [&](PictureOptions options) {
        options.size = {640, 480};
        Scene scene{.lights = {{.vector = sun, .directional = true}}, .camera = camera};
        frame_ground(scene, mesh, options);
        CHECK(scene.camera.eye == camera.eye);
        double farthest = 0.0;
        for (const glm::vec3& p : mesh.positions()) {
            const glm::dvec3 shadow = glm::dvec3(p) - (p.y - ground) / sun.y * sun;
            farthest = std::max(farthest, place_in_picture(scene.camera, shadow));
        }
        return farthest;
    };
    CHECK(most({.eye = glm::vec3(2.5f, 2, 4)}) < 0.96);
    // What the user fixed stays.
    CHECK(most({.eye = glm::vec3(2.5f, 2, 4), .fov_degrees = 35.0}) > 1.0);
    CHECK(most({.eye = glm::vec3(2.5f, 2, 4), .target = glm::vec3(0.0f)}) > 1.0);
}

TEST_CASE("the frame holds the shadow of a lamp, and endless shadows fade out within three radii") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const glm::dvec3 up(0, 1, 0);
    const Camera camera =
        fit_camera({.fov_y_deg = 35.0}, mesh, default_view_direction(up), k_aspect);
    const auto farther = [&](const Light& light) {
        const Camera framed = frame_with_shadows(camera, mesh, {&light, 1}, up, k_aspect);
        return glm::distance(framed.eye, framed.target) / glm::distance(camera.eye, camera.target);
    };
    const auto fade = [&](const Light& light) {
        return fade_of_ground(mesh, {&light, 1}, up) / mesh.radius();
    };
    const Light lamp{.vector = mesh.center() + mesh.radius() * glm::dvec3(3, 5, 1),
                     .directional = false};
    CHECK(farther(lamp) > 1.02);
    CHECK(fade(lamp) == doctest::Approx(7.0));
    double ground = 1e9;
    for (const glm::vec3& p : mesh.positions()) ground = std::min(ground, double{p.y});
    const Camera framed = frame_with_shadows(camera, mesh, {&lamp, 1}, up, k_aspect);
    for (const glm::vec3& p : mesh.positions()) {
        const glm::dvec3 ray = glm::dvec3(p) - lamp.vector;
        CHECK(place_in_picture(framed, lamp.vector + (ground - lamp.vector.y) / ray.y * ray) <
              0.96);
    }
    // A low sun, a lamp as high as the mesh, and a light from below.
    for (const Light& low : {Light{.vector = {1, 0.05, 0}},
                             Light{.vector = mesh.center() + mesh.radius() * glm::dvec3(3, 0, 1),
                             .directional = false},
                             Light{.vector = {1, -1, 0}}}) {
        CHECK(fade(low) == doctest::Approx(3.0));
        CHECK(farther(low) < 4.0);
    }
    Light soft{.vector = {1, 0.05, 0}, .casts_shadows = false};
    CHECK(fade(soft) == doctest::Approx(7.0));
    CHECK(farther(soft) == doctest::Approx(1.0));
}

}  // namespace
}  // namespace rimline::tools
