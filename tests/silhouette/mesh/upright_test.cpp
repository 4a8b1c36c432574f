#include "silhouette/mesh/upright.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/trigonometric.hpp>
#include <initializer_list>
#include <stop_token>
#include <string>

#include "silhouette/error.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/models.h"
#include "tests/skip.h"

namespace rimline {
namespace {

constexpr glm::dvec3 k_y(0, 1, 0);

void add_box(MeshSource& source, const glm::vec3& low, const glm::vec3& high) {
    const auto first = static_cast<std::uint32_t>(source.positions.size());
    for (int corner = 0; corner < 8; ++corner)
        source.positions.emplace_back(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                      corner & 4 ? high.z : low.z);
    for (const auto& [a, b, c, d] : std::initializer_list<std::array<std::uint32_t, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        source.triangles.push_back({first + a, first + b, first + c});
        source.triangles.push_back({first + a, first + c, first + d});
    }
}

void add_octahedron(MeshSource& source, const glm::vec3& center, const glm::vec3& reach) {
    const auto first = static_cast<std::uint32_t>(source.positions.size());
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f}) {
            glm::vec3 corner = center;
            corner[axis] += sign * reach[axis];
            source.positions.push_back(corner);
        }
    for (const std::uint32_t x : {0u, 1u})
        for (const std::uint32_t y : {2u, 3u})
            for (const std::uint32_t z : {4u, 5u})
                source.triangles.push_back({first + x, first + y, first + z});
}

// Four legs, a body without a flat side, a neck and a head: up is y.
MeshSource animal() {
    MeshSource source;
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-0.3f, 0.3f})
            add_box(source, {x - 0.1f, 0.0f, z - 0.1f}, {x + 0.1f, 1.7f, z + 0.1f});
    add_octahedron(source, {0.0f, 1.75f, 0.0f}, {1.7f, 0.45f, 0.9f});
    add_box(source, {1.0f, 1.7f, -0.15f}, {1.3f, 3.0f, 0.15f});
    add_box(source, {1.0f, 2.8f, -0.2f}, {1.8f, 3.1f, 0.2f});
    return source;
}

// Moves the y axis to this one by a rotation.
MeshSource with_up(MeshSource source, const glm::dvec3& up) {
    for (glm::vec3& p : source.positions) {
        if (up.x != 0.0) p = {float(up.x) * p.y, -float(up.x) * p.x, p.z};
        if (up.y < 0.0) p = {-p.x, -p.y, p.z};
        if (up.z != 0.0) p = {p.x, -float(up.z) * p.z, float(up.z) * p.y};
    }
    return source;
}

TEST_CASE("an animal on four legs is turned upright from wherever it lies") {
    for (const glm::dvec3& up : k_axis_directions) {
        CAPTURE(up.x);
        CAPTURE(up.z);
        CHECK(choose_upright(Mesh(with_up(animal(), up))) == up);
    }
}

TEST_CASE("evidence is that of the closed form") {
    MeshSource source;
    add_box(source, {0, 0, 0}, {2, 4, 6});
    const UprightEvidence box = measure_upright(Mesh(source));
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(box.standing[i].contact == doctest::Approx(1.0));
        CHECK(box.standing[i].flat == doctest::Approx(1.0));
        CHECK(box.standing[i].mass_height == doctest::Approx(0.5));
    }
    CHECK(glm::degrees(box.standing[2].tip_rad) == doctest::Approx(26.565));  // atan(1 / 2)
    CHECK(glm::degrees(box.standing[4].tip_rad) == doctest::Approx(18.435));  // atan(1 / 3)
    for (const double symmetry : box.symmetry)
        CHECK(symmetry == doctest::Approx(1.0).epsilon(1e-3));
    // A square pyramid: on its base, and on its tip.
    const Mesh pyramid(MeshSource{
        .positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {0, 5, 0}},
        .triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}}});
    const UprightEvidence cone = measure_upright(pyramid);
    CHECK(cone.standing[2].contact == doctest::Approx(1.0));
    CHECK(cone.standing[3].contact < 0.01);
    CHECK(cone.standing[3].flat == 0.0);
    CHECK(cone.symmetry[0] == doctest::Approx(1.0).epsilon(1e-3));
    CHECK(cone.symmetry[1] < 0.6);
}

TEST_CASE("built-in shapes stay as they are") {
    for (const std::string_view name : k_built_in_shapes)
        for (const std::uint32_t faces : {500u, 20'000u}) {
            CAPTURE(name);
            CAPTURE(faces);
            const MeshSource source = make_built_in_shape(name, faces);
            CHECK(source.is_up_known);
            CHECK(choose_upright(Mesh(source)) == k_y);
        }
}

TEST_CASE("nothing is turned that stands along y, or that stands as well along two directions") {
    // A person with broad feet, who would lie better than stand.
    MeshSource person;
    for (const float x : {-0.25f, 0.25f})
        add_box(person, {x - 0.15f, 0.0f, -0.2f}, {x + 0.15f, 2.0f, 0.25f});
    add_box(person, {-0.5f, 1.9f, -0.2f}, {0.5f, 3.3f, 0.2f});
    add_box(person, {-0.2f, 3.3f, -0.2f}, {0.2f, 3.9f, 0.2f});
    CHECK(choose_upright(Mesh(person)) == k_y);
    // A plate along z has two equal sides.
    MeshSource plate;
    add_box(plate, {-1, -1, -0.1f}, {1, 1, 0.1f});
    CHECK(choose_upright(Mesh(plate)) == k_y);
}

TEST_CASE("a mesh that is a point, a line, a plane or nothing stays as it is") {
    CHECK(choose_upright(Mesh(MeshSource{})) == k_y);
    CHECK(choose_upright(Mesh(MeshSource{.positions = {{1, 2, 3}}, .triangles = {{0, 0, 0}}})) ==
          k_y);
    CHECK(choose_upright(Mesh(MeshSource{.positions = {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}},
                                         .triangles = {{0, 1, 2}}})) == k_y);
    CHECK(choose_upright(Mesh(MeshSource{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 2}},
                                         .triangles = {{0, 1, 2}}})) == k_y);
}

TEST_CASE("the choice does not depend on place, size or the order of faces") {
    MeshSource source = with_up(animal(), {0, 0, 1});
    for (glm::vec3& p : source.positions) p = p * 1024.0f + glm::vec3(4096, -512, 2048);
    std::reverse(source.triangles.begin(), source.triangles.end());
    CHECK(choose_upright(Mesh(source)) == glm::dvec3(0, 0, 1));
}

TEST_CASE("the horse and Nefertiti stand, and models that stand along y stay") {
    struct Known {
        const char* name;
        glm::dvec3 up;
    };
    bool found = false;
    for (const auto& [name, up] : {Known{"horse.ply", {0, 0, 1}},
                                   {"nefertiti.obj", {0, 0, 1}},
                                   {"alligator.obj", k_y},
                                   {"beetle-alt.obj", k_y},
                                   {"igea.ply", k_y},
                                   {"ogre.obj", k_y},
                                   {"stanford-bunny.obj", k_y}})
        if (const auto path = tests::find_model(name)) {
            CAPTURE(name);
            CHECK(choose_upright(Mesh(read_mesh_file(*path))) == up);
            found = true;
        }
    if (!found) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds models");
}

TEST_CASE("the choice of an up direction that is asked to stop says so") {
    std::stop_source stop;
    const Mesh mesh(with_up(animal(), {0, 0, 1}));
    CHECK(choose_upright(mesh, stop.get_token()) == glm::dvec3(0, 0, 1));
    stop.request_stop();
    CHECK_THROWS_WITH_AS(choose_upright(mesh, stop.get_token()), "cancelled", Error);
}

}  // namespace
}  // namespace rimline
