#include "silhouette/mesh/edge_visibility.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <doctest/doctest.h>

#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;

namespace {

MeshSource with(std::vector<glm::vec3> positions,
                std::vector<std::array<std::uint32_t, 3>> triangles) {
    MeshSource source;
    source.positions = std::move(positions);
    source.triangles = std::move(triangles);
    return source;
}

// The classes without any crease.
std::vector<EdgeVisibility> smooth(const Mesh& mesh) {
    return edge_visibility(mesh, std::vector<std::uint8_t>(mesh.edge_count(), 0));
}

// Of the edge between positions `a` and `b` of the source.
EdgeVisibility between(const Mesh& mesh, std::span<const EdgeVisibility> edges, std::uint32_t a,
                       std::uint32_t b) {
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const auto [from, to] = mesh.edge(EdgeId{e}).vertices;
        const std::uint32_t x = mesh.file_vertex(from), y = mesh.file_vertex(to);
        if ((x == a && y == b) || (x == b && y == a)) return edges[e];
    }
    FAIL("no such edge");
    return EdgeVisibility::hidden;
}

// Two triangles on the edge from (0, 0, 0) to (0, 1, 0), the second up by `angle` out of the first's plane.
Mesh hinge(double angle_deg) {
    const double angle = glm::radians(angle_deg);
    return Mesh(with(
        {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {float(std::cos(angle)), 0, float(std::sin(angle))}},
        {{0, 1, 2}, {1, 0, 3}}));
}

}  // namespace

TEST_CASE(
    "edge visibility: ridges and valleys are silhouette edges, what is flat is hidden, borders are "
    "hard") {
    for (const double angle : {-170.0, -40.0, -0.01, 0.01, 40.0, 170.0, 180.0}) {
        CAPTURE(angle);
        const Mesh mesh = hinge(angle);
        CHECK(between(mesh, smooth(mesh), 0, 1) == EdgeVisibility::silhouette);
    }
    const Mesh flat = hinge(0.0);
    CHECK(between(flat, smooth(flat), 0, 1) == EdgeVisibility::hidden);
    CHECK(between(flat, smooth(flat), 0, 2) == EdgeVisibility::hard);
    CHECK(count_classes(smooth(flat)) == EdgeVisibilityCounts{1, 0, 4});
}

TEST_CASE("edge visibility: the diagonals of a box are hidden however it is turned") {
    for (int turn = 0; turn < 50; ++turn) {
        MeshSource box = make_built_in_shape("box", 48);
        const glm::dquat rotation =
            glm::angleAxis(0.37 * turn, glm::normalize(glm::dvec3(turn % 7 - 3, 2, turn % 5)));
        for (glm::vec3& p : box.positions) p = rotation * (glm::dvec3(p) + glm::dvec3(3, 5, 7));
        const Mesh mesh(box);
        const EdgeVisibilityCounts counts =
            count_classes(edge_visibility(mesh, crease_flags(mesh, 0.5f)));
        CAPTURE(turn);
        // Twelve edges of two pieces each; all others lie in sides.
        CHECK(counts.silhouette == 0);
        CHECK(counts.hard == 24);
        CHECK(counts.hidden == mesh.edge_count() - 24);
    }
}

TEST_CASE("edge visibility: creases by angle are hard, both at ridges and at valleys") {
    for (const double sign : {-1.0, 1.0}) {
        const Mesh mesh = hinge(sign * 30.0);
        const auto at = [&](double deg) {
            return between(
                mesh, edge_visibility(mesh, crease_flags(mesh, float(glm::radians(deg)))), 0, 1);
        };
        CHECK(at(29.9) == EdgeVisibility::hard);
        CHECK(at(30.1) == EdgeVisibility::silhouette);
    }
    const Mesh flat = hinge(0.0);
    CHECK(crease_flags(flat, 0.0f) == std::vector<std::uint8_t>(flat.edge_count(), 0));
}

TEST_CASE(
    "edge visibility: edges of three faces are hard, of turned faces as others, of faces without "
    "area hidden") {
    const Mesh three(with({{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0.5f}, {0.5f, 0, 1}},
                          {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}));
    CHECK(between(three, smooth(three), 0, 1) == EdgeVisibility::hard);
    const Mesh turned(
        with({{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0.5f}}, {{0, 1, 2}, {0, 1, 3}}));
    CHECK(between(turned, smooth(turned), 0, 1) == EdgeVisibility::silhouette);
    const Mesh turned_flat(
        with({{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}));
    CHECK(between(turned_flat, smooth(turned_flat), 0, 1) == EdgeVisibility::hidden);
    const Mesh sliver(with({{0, 0, 0}, {0, 2, 0}, {-1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}));
    CHECK(between(sliver, smooth(sliver), 0, 1) == EdgeVisibility::hidden);
    const Mesh empty(with({{0, 0, 0}}, {}));
    CHECK(smooth(empty).empty());
}

TEST_CASE("edge visibility: of several codes of an edge the strongest counts") {
    // The edge from corner 0 to 1 of both faces; all others of the second are hard.
    const Mesh mesh = hinge(40.0);
    const auto class_by = [&](unsigned first, unsigned second) {
        const std::vector<std::uint8_t> codes{std::uint8_t(first), std::uint8_t(second | 0x28)};
        const std::vector<EdgeVisibility> edges = edge_visibility_of_codes(mesh, codes);
        CHECK(between(mesh, edges, 1, 2) == EdgeVisibility::hidden);
        CHECK(between(mesh, edges, 0, 3) == EdgeVisibility::hard);
        return between(mesh, edges, 0, 1);
    };
    CHECK(class_by(0, 0) == EdgeVisibility::hidden);
    CHECK(class_by(1, 0) == EdgeVisibility::silhouette);
    CHECK(class_by(0, 1) == EdgeVisibility::silhouette);
    CHECK(class_by(2, 3) == EdgeVisibility::hard);
    CHECK(class_by(3, 2) == EdgeVisibility::hard);
    CHECK(class_by(1, 2) == EdgeVisibility::hard);
}
