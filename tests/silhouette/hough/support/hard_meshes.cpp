#include "tests/silhouette/hough/support/hard_meshes.h"

#include <cmath>
#include <numbers>
#include <random>

#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline::tests {

namespace {

using Corners = std::array<std::uint32_t, 3>;

MeshSource duplicated(const MeshSource& source) { return joined(source, source); }

// Triangles around one point in the plane y = height: one Hough point, however many they are.
MeshSource coplanar_fan(std::uint32_t faces, float height) {
    MeshSource fan;
    fan.positions.emplace_back(0.0f, height, 0.0f);
    for (std::uint32_t i = 0; i < faces; ++i) {
        const double angle_rad = 2.0 * std::numbers::pi * i / faces;
        fan.positions.emplace_back(std::cos(angle_rad), height, -std::sin(angle_rad));
        fan.triangles.push_back(Corners{0, i + 1, (i + 1) % faces + 1});
    }
    return fan;
}

// Half a turn over its length: one edge at least is run the same way by both faces.
MeshSource moebius_strip(std::uint32_t segments) {
    MeshSource strip;
    for (std::uint32_t i = 0; i < segments; ++i) {
        const double turn_rad = 2.0 * std::numbers::pi * i / segments;
        for (const double side : {-0.4, 0.4}) {
            const double radius = 1.0 + side * std::cos(turn_rad / 2.0);
            strip.positions.emplace_back(radius * std::cos(turn_rad),
                                         side * std::sin(turn_rad / 2.0),
                                         radius * std::sin(turn_rad));
        }
        const std::uint32_t a = 2 * i;
        const std::uint32_t b = a + 1;
        const bool last = i + 1 == segments;
        const std::uint32_t c = last ? 1 : a + 2;
        const std::uint32_t d = last ? 0 : a + 3;
        strip.triangles.push_back(Corners{a, b, c});
        strip.triangles.push_back(Corners{c, b, d});
    }
    return strip;
}

// Pages that all meet at one spine; every second one bound the wrong way round.
MeshSource book(std::uint32_t pages) {
    MeshSource pages_of;
    pages_of.positions = {{0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    for (std::uint32_t i = 0; i < pages; ++i) {
        const double angle_rad = 2.0 * std::numbers::pi * i / pages;
        pages_of.positions.emplace_back(std::cos(angle_rad), 0.1 * i, std::sin(angle_rad));
        if (i % 2 == 0)
            pages_of.triangles.push_back(Corners{0, 1, i + 2});
        else
            pages_of.triangles.push_back(Corners{1, 0, i + 2});
    }
    return pages_of;
}

// Triangles without a plane between ones that have one: collinear corners, and equal ones.
MeshSource with_degenerate_faces() {
    MeshSource mesh = box({0.0f, 0.0f, 0.0f}, {1.0f, 2.0f, 3.0f});
    mesh.positions.emplace_back(0.5f, 0.0f, 0.0f);
    mesh.triangles.push_back(Corners{0, 8, 1});
    mesh.triangles.push_back(Corners{2, 2, 3});
    return mesh;
}

// One part is 2^-40 of the whole: octants of one cube do not reach it.
MeshSource speck_beside_a_giant() {
    return joined(
        placed(make_built_in_shape("torus", 2000), 0x1p-20, {0.0, 0.0, 0.0}),
        placed(box({-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f}), 0x1p20, {0x1p22, 0.0, 0.0}));
}

}  // namespace

MeshSource triangle_soup(std::uint32_t faces, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
    MeshSource soup;
    // Few positions for many faces: edges of every class come about.
    const std::uint32_t count = faces / 8 + 3;
    for (std::uint32_t i = 0; i < count; ++i)
        soup.positions.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    std::uniform_int_distribution<std::uint32_t> corner(0, count - 1);
    for (std::uint32_t i = 0; i < faces; ++i)
        soup.triangles.push_back(Corners{corner(random), corner(random), corner(random)});
    return soup;
}

MeshSource box(glm::vec3 low, glm::vec3 high) {
    MeshSource mesh;
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                                    i & 4 ? high.z : low.z);
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return mesh;
}

MeshSource placed(MeshSource source, double scale, glm::dvec3 offset) {
    for (glm::vec3& p : source.positions) p = glm::vec3(scale * glm::dvec3(p) + offset);
    return source;
}

MeshSource joined(MeshSource a, const MeshSource& b) {
    const auto shift = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const Corners& t : b.triangles)
        a.triangles.push_back(Corners{t[0] + shift, t[1] + shift, t[2] + shift});
    return a;
}

std::vector<NamedSource> hard_meshes() {
    const MeshSource unit_box = box({-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f});
    // Its center, the origin of Hough space, lies in the planes of the inner faces.
    const MeshSource walls = joined(joined(unit_box, box({0.0f, 0.0f, 0.0f}, {0.5f, 0.5f, 0.5f})),
                                    coplanar_fan(64, 0.0f));
    MeshSource one_face;
    one_face.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.5f}};
    one_face.triangles = {{0, 1, 2}};
    const MeshSource torus = make_built_in_shape("torus", 1500);
    return {{"triangle soup", triangle_soup(2000, 11)},
            {"sparse soup", placed(triangle_soup(300, 12), 100.0, {3.0, -50.0, 7.0})},
            {"coplanar fan", coplanar_fan(10000, 0.75f)},
            {"box at the origin", unit_box},
            {"planes through the origin", walls},
            {"duplicates", duplicated(torus)},
            {"one face", one_face},
            {"empty", {}},
            {"Moebius strip", moebius_strip(101)},
            {"book", book(9)},
            {"thick book", book(200)},
            {"degenerate faces", with_degenerate_faces()},
            {"far away", placed(torus, 1.0, {1e6, -1e6, 1e6})},
            {"huge", placed(torus, 0x1p40, {0.0, 0.0, 0.0})},
            {"tiny", placed(torus, 0x1p-40, {0.0, 0.0, 0.0})},
            {"speck beside a giant", speck_beside_a_giant()}};
}

std::vector<NamedSource> made_meshes(std::uint32_t faces) {
    std::vector<NamedSource> all = hard_meshes();
    for (const std::string_view name : k_built_in_shapes)
        all.push_back({std::string(name), make_built_in_shape(name, faces)});
    return all;
}

}  // namespace rimline::tests
