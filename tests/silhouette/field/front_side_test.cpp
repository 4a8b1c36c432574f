#include "silhouette/field/front_side.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stop_token>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/ground_axes.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/winding.h"
#include "tests/models.h"
#include "tests/skip.h"

using namespace rimline;

namespace {

// A sphere with bumps on the side where dot(position, towards) > 0.
MeshSource face(const glm::dvec3& towards, double height) {
    MeshSource source = make_built_in_shape("sphere", 20'000);
    source.is_up_known = false;
    for (glm::vec3& p : source.positions) {
        const glm::dvec3 q(p);
        const double front = std::max(glm::dot(glm::normalize(q), towards), 0.0);
        const double bump = std::sin(13.0 * q.x) * std::sin(11.0 * q.y) * std::sin(17.0 * q.z);
        p = glm::vec3(q * (1.0 + height * front * (bump + 0.3 * std::sin(9.0 * q.x + 7.0 * q.y))));
    }
    return source;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)));
}

}  // namespace

TEST_CASE("a mesh faces where it has its detail, whatever its axes and size") {
    for (const glm::dvec3 towards : {glm::dvec3(1, 0, 0), {0, 0, -1}, {-0.6, 0, 0.8}}) {
        CAPTURE(towards.x);
        MeshSource source = face(towards, 0.2);
        const FrontSide front = find_front_side(Mesh(source), {0, 1, 0});
        CHECK(front.certainty > 0.5);
        CHECK(glm::length(front.towards) == doctest::Approx(1.0));
        CHECK(front.towards.y == doctest::Approx(0.0));
        CHECK(degrees_between(front.towards, towards) < 35.0);
        for (glm::vec3& p : source.positions) p = 1000.0f * p + glm::vec3(500, 0, 0);
        const FrontSide large = find_front_side(Mesh(source), {0, 1, 0});
        CHECK(degrees_between(large.towards, front.towards) < 1.0);
        const FrontSide inside_out = find_front_side(turned_inside_out(Mesh(source)), {0, 1, 0});
        CHECK(degrees_between(inside_out.towards, front.towards) < 1.0);
        // y to z, where the file says nothing about it.
        for (glm::vec3& p : source.positions) p = {p.x, -p.z, p.y};
        const glm::dvec3 turned{towards.x, -towards.z, towards.y};
        CHECK(degrees_between(find_front_side(Mesh(source), {0, 0, 1}).towards, turned) < 35.0);
    }
}

TEST_CASE("a mesh with as much detail all around faces the file's front, if the file has one") {
    MeshSource source = make_built_in_shape("sphere", 5000);
    source.is_up_known = false;
    const FrontSide usual = find_front_side(Mesh(source), {0, 1, 0});
    CHECK(degrees_between(usual.towards, {0, 0, 1}) < 1.0);
    CHECK(usual.certainty > 0.1);
    CHECK(usual.certainty < 0.5);
    CHECK(find_front_side(Mesh(source), {0, 0, 1}).certainty == 0.0);
    source.is_up_known = true;
    source.up = UpAxis::z;
    CHECK(degrees_between(find_front_side(Mesh(source), {0, 0, 1}).towards, {0, -1, 0}) < 1.0);
    CHECK(find_front_side(Mesh(MeshSource{}), {0, 1, 0}).certainty == 0.0);
}

TEST_CASE("people, heads and animals face where people say they do") {
    struct Known {
        const char* name;
        glm::dvec3 up;
        double azimuth_deg;
    };
    int found = 0;
    for (const Known& known : {Known{"igea.ply", {0, 1, 0}, 10},
                               {"nefertiti.obj", {0, 0, 1}, 0},
                               {"ogre.obj", {0, 1, 0}, 0},
                               {"stanford-bunny.obj", {0, 1, 0}, 330},
                               {"beetle-alt.obj", {0, 1, 0}, 0}}) {
        const auto path = tests::find_model(known.name);
        if (!path) continue;
        const Mesh mesh(read_mesh_file(*path, FaceRequirement::faces));
        ++found;
        CAPTURE(known.name);
        const auto [right, away] = ground_axes(known.up);
        const double azimuth = glm::radians(known.azimuth_deg);
        const glm::dvec3 expected = std::sin(azimuth) * right - std::cos(azimuth) * away;
        const FrontSide front = find_front_side(mesh, known.up);
        CHECK(degrees_between(front.towards, expected) < 25.0);
        CHECK(front.certainty > 0.5);
    }
    if (found == 0) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds one of them");
}

TEST_CASE("looking for a front is cancelled") {
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(
        find_front_side(Mesh(make_built_in_shape("knot", 2000)), {0, 1, 0}, stop.get_token()),
        Error);
}
