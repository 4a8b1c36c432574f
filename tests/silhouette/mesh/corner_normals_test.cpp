#include "silhouette/mesh/corner_normals.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;

float radians(float degrees) { return degrees * k_pi / 180.0f; }

void check_unit(const Mesh& mesh, const std::vector<glm::vec3>& normals) {
    REQUIRE(normals.size() == 3 * std::size_t{mesh.face_count()});
    for (const glm::vec3& n : normals) REQUIRE(std::abs(glm::dot(n, n) - 1.0f) < 1e-5f);
}

glm::dvec3 face_normal(const Mesh& mesh, std::uint32_t face) {
    const Plane& plane = mesh.planes()[face];
    return {plane.nx, plane.ny, plane.nz};
}

// What the header says, corner by corner: walk from the face around its vertex.
glm::dvec3 walked_normal(const Mesh& mesh, std::uint32_t face, VertexId vertex, double crease) {
    std::vector<std::uint32_t> reached{face};
    std::set<std::uint32_t> seen{face};
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const std::uint32_t f = reached[i];
        const Triangle& t = mesh.triangles()[f];
        const std::uint32_t c = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
        const auto at = [&](std::uint32_t corner) {
            return glm::dvec3(mesh.positions()[index(t[corner % 3])]);
        };
        const glm::dvec3 a = glm::normalize(at(c + 1) - at(c));
        const glm::dvec3 b = glm::normalize(at(c + 2) - at(c));
        sum += std::acos(glm::dot(a, b)) * face_normal(mesh, f);
        for (const EdgeId e : mesh.edges_of(FaceId{f})) {
            const Edge& edge = mesh.edge(e);
            if (mesh.edge_class(e) != EdgeClass::regular) continue;
            if (edge.vertices[0] != vertex && edge.vertices[1] != vertex) continue;
            const std::uint32_t other = index(edge.faces[index(edge.faces[0]) == f ? 1 : 0]);
            const double bend =
                std::acos(std::min(1.0, glm::dot(face_normal(mesh, f), face_normal(mesh, other))));
            if (bend <= crease && seen.insert(other).second) reached.push_back(other);
        }
    }
    const glm::dvec3 mean = glm::normalize(sum);
    const bool is_tip = std::ranges::any_of(reached, [&](std::uint32_t f) {
        return std::acos(std::min(1.0, glm::dot(face_normal(mesh, f), mean))) > crease;
    });
    return is_tip ? face_normal(mesh, face) : mean;
}

}  // namespace

TEST_CASE("corner normals of an empty mesh are none") {
    CHECK(corner_normals(Mesh{MeshSource{}}, 0.5f).empty());
}

TEST_CASE("a sphere's corner normals are its points") {
    for (const std::uint32_t faces : {320u, 5000u, 50'000u}) {
        CAPTURE(faces);
        const Mesh mesh(make_built_in_shape("sphere", faces));
        const auto normals = corner_normals(mesh, radians(60));
        check_unit(mesh, normals);
        double worst = 0.0;
        for (std::uint32_t i = 0; i < normals.size(); ++i) {
            const glm::vec3 p = mesh.positions()[index(mesh.triangles()[i / 3][i % 3])];
            worst = std::max(worst, double(glm::length(normals[i] - p)));
        }
        CHECK(worst < 8.0 / faces);  // Quadratic in the size of a face.
    }
}

TEST_CASE("a box is flat below 90 degrees, and its corners are diagonal above") {
    const Mesh mesh(make_built_in_shape("box", 300));
    for (const float degrees : {0.0f, 30.0f, 89.9f}) {
        CAPTURE(degrees);
        const auto normals = corner_normals(mesh, radians(degrees));
        for (std::uint32_t i = 0; i < normals.size(); ++i)
            CHECK(glm::length(glm::dvec3(normals[i]) - face_normal(mesh, i / 3)) < 1e-6);
    }
    for (const float degrees : {90.0f, 120.0f, 180.0f}) {
        CAPTURE(degrees);
        const auto normals = corner_normals(mesh, radians(degrees));
        check_unit(mesh, normals);
        for (std::uint32_t i = 0; i < normals.size(); ++i) {
            // On a side one component of the point is 1, on an edge two, at a corner three: each of
            // those sides has the same angle there.
            const glm::vec3 p = mesh.positions()[index(mesh.triangles()[i / 3][i % 3])];
            glm::vec3 expected(0.0f);
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(p[axis]) == 1.0f) expected[axis] = p[axis];
            CHECK(glm::length(normals[i] - glm::normalize(expected)) < 1e-5f);
        }
    }
}

TEST_CASE("corner normals are those of a walk around each vertex") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        tests::Random random(seed);
        MeshSource source = make_built_in_shape(seed % 3 == 0   ? "torus"
                                                : seed % 3 == 1 ? "sphere"
                                                                : "terrain",
                                                200);
        for (glm::vec3& p : source.positions) p += 0.08f * random.in_cube();
        // A few faces turned over or doubled, so that there are edges of every class.
        for (int i = 0; i < 5; ++i) {
            auto& t = source.triangles[random.below(200 / 2)];
            std::swap(t[0], t[1]);
            const auto doubled = source.triangles[random.below(200 / 2)];
            source.triangles.push_back(doubled);
        }
        const Mesh mesh(source);
        REQUIRE(mesh.edges_of_class(EdgeClass::nonmanifold).size() > 0);
        REQUIRE(mesh.edges_of_class(EdgeClass::inconsistent).size() > 0);
        for (const float degrees : {1.0f, 20.0f, 35.0f, 60.0f, 110.0f}) {
            CAPTURE(degrees);
            const auto normals = corner_normals(mesh, radians(degrees));
            check_unit(mesh, normals);
            for (std::uint32_t i = 0; i < normals.size(); ++i) {
                const VertexId vertex = mesh.triangles()[i / 3][i % 3];
                const glm::dvec3 expected =
                    walked_normal(mesh, i / 3, vertex, double(radians(degrees)));
                REQUIRE(glm::length(glm::dvec3(normals[i]) - expected) < 1e-5);
            }
        }
    }
}

TEST_CASE("faces that meet only at a vertex or a non-manifold edge do not mix") {
    const Mesh mesh(tests::book(4));
    const auto normals = corner_normals(mesh, k_pi);
    for (std::uint32_t i = 0; i < normals.size(); ++i)
        CHECK(glm::length(glm::dvec3(normals[i]) - face_normal(mesh, i / 3)) < 1e-6);
}

TEST_CASE("degenerate faces weigh nothing and take a neighbor's normal") {
    // A flat square with a collinear sliver along its diagonal, and a triangle of equal corners.
    const Mesh mesh({{{0, 0, 0}, {0, 0, 1}, {0, -1, 1}, {0, -1, 0}, {0, -0.5f, 0.5f}, {5, 5, 5}},
                     {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}, {5, 5, 0}}});
    REQUIRE(mesh.degenerate_face_count() == 2);
    const auto normals = corner_normals(mesh, radians(30));
    check_unit(mesh, normals);
    // The triangle of equal corners has no neighbor.
    for (std::uint32_t i = 0; i < normals.size(); ++i)
        CHECK(glm::length(normals[i] - (i < 12 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0))) < 1e-6f);
}

TEST_CASE("a sliver between smooth faces does not make a crease") {
    // Two faces bent by about 11 degrees, with a collinear triangle along their common line.
    const Mesh mesh({{{0, 0, 0}, {0, 2, 0}, {0, 1, 0}, {0.1f, 1, 1}, {0.1f, 1, -1}},
                     {{0, 1, 3}, {0, 2, 1}, {0, 4, 2}, {2, 4, 1}}});
    REQUIRE(mesh.degenerate_face_count() == 1);
    const auto smooth = corner_normals(mesh, radians(20));
    const auto sharp = corner_normals(mesh, radians(5));
    const glm::vec3 across(1, 0, 0);
    CHECK(glm::length(smooth[0] - across) < 1e-3f);
    CHECK(glm::length(smooth[6] - across) < 1e-3f);
    CHECK(glm::length(glm::dvec3(sharp[0]) - face_normal(mesh, 0)) < 1e-6);
}

TEST_CASE("a mesh of nothing but degenerate faces has finite normals") {
    const Mesh mesh(
        {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {1, 2, 3}, {3, 3, 0}}});
    REQUIRE(mesh.degenerate_face_count() == 3);
    check_unit(mesh, corner_normals(mesh, radians(30)));
}

TEST_CASE("normals that cancel leave each face its own") {
    const Mesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
    for (const float crease : {0.0f, 1.0f, k_pi}) {
        const auto normals = corner_normals(mesh, crease);
        for (std::uint32_t i = 0; i < 6; ++i) CHECK(normals[i].z == (i < 3 ? 1.0f : -1.0f));
    }
}

TEST_CASE("a vertex of very high valence takes no longer than many vertices") {
    // A cone of 200,000 faces; looking at each pair around its tip would take hours.
    constexpr std::uint32_t k_sides = 200'000;
    MeshSource source;
    source.positions.emplace_back(0.0f, 1.0f, 0.0f);
    for (std::uint32_t i = 0; i < k_sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / k_sides;
        source.positions.emplace_back(float(std::sin(angle)), 0.0f, float(std::cos(angle)));
        source.triangles.push_back({0, 1 + i, 1 + (i + 1) % k_sides});
    }
    const Mesh mesh(tests::shuffled(source, 1));
    const auto normals = corner_normals(mesh, radians(50));
    check_unit(mesh, normals);
    for (std::uint32_t i = 0; i < normals.size(); ++i)
        if (mesh.positions()[index(mesh.triangles()[i / 3][i % 3])].y == 1.0f)
            REQUIRE(glm::length(normals[i] - glm::vec3(0, 1, 0)) < 1e-3f);
}

TEST_CASE("tiny and huge meshes have the same corner normals") {
    const MeshSource source = make_built_in_shape("knot", 1000);
    const auto expected = corner_normals(Mesh(source), radians(40));
    for (const float scale : {0x1p-100f, 0x1p-10f, 0x1p58f}) {
        CAPTURE(scale);
        MeshSource other = source;
        for (glm::vec3& p : other.positions) p *= scale;
        const auto normals = corner_normals(Mesh(other), radians(40));
        for (std::size_t i = 0; i < expected.size(); ++i)
            REQUIRE(glm::length(normals[i] - expected[i]) < 1e-6f);
    }
}

TEST_CASE("the faces of a cone have their own normals at its tip and share them elsewhere") {
    constexpr std::uint32_t sides = 32;
    for (const float height : {0.3f, 1.0f, 4.0f}) {
        CAPTURE(height);
        MeshSource cone{.positions = {{0.0f, height, 0.0f}}};
        for (std::uint32_t i = 0; i < sides; ++i) {
            const float turn = 2.0f * k_pi * float(i) / float(sides);
            cone.positions.emplace_back(std::cos(turn), 0.0f, -std::sin(turn));
            cone.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
        }
        const Mesh mesh(cone);
        const auto normals = corner_normals(mesh, radians(40));
        const bool is_steep = height > 0.9f;
        for (std::uint32_t f = 0; f < sides; ++f)
            for (std::uint32_t c = 0; c < 3; ++c) {
                const bool is_tip = index(mesh.triangles()[f][c]) == 0;
                const glm::dvec3 expected =
                    is_tip && !is_steep ? glm::dvec3(0.0, 1.0, 0.0)
                    : is_tip            ? face_normal(mesh, f)
                             : walked_normal(mesh, f, mesh.triangles()[f][c], radians(40));
                CHECK(glm::length(glm::dvec3(normals[3 * f + c]) - expected) < 1e-6);
            }
        CHECK(corner_groups(mesh, radians(40)).begin.size() - 1 == sides + (is_steep ? sides : 1));
    }
}

TEST_CASE("corners of one group share their normal, and the groups hold every corner once") {
    for (const char* name : {"box", "knot", "terrain"}) {
        const Mesh mesh(make_built_in_shape(name, 1000));
        const auto normals = corner_normals(mesh, radians(40));
        const CornerGroupList groups = corner_groups(mesh, radians(40));
        std::vector<std::uint32_t> seen(normals.size(), 0);
        for (std::size_t g = 0; g + 1 < groups.begin.size(); ++g)
            for (std::uint32_t i = groups.begin[g]; i < groups.begin[g + 1]; ++i) {
                ++seen[groups.corners[i]];
                REQUIRE(normals[groups.corners[i]] == normals[groups.corners[groups.begin[g]]]);
                REQUIRE((i == groups.begin[g] || groups.corners[i - 1] < groups.corners[i]));
            }
        CHECK(std::ranges::all_of(seen, [](std::uint32_t count) { return count == 1; }));
    }
    const Mesh box(make_built_in_shape("box", 12));
    CHECK(corner_groups(box, radians(40)).begin.size() - 1 == 24);
    CHECK(corner_groups(box, k_pi).begin.size() - 1 == 8);
    CHECK(corner_groups(Mesh(MeshSource{}), 0.0f).corners.empty());
}

}  // namespace rimline
