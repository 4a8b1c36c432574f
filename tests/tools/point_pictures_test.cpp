// What pictures of point clouds are made of.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/points/sample_clouds.h"
#include "tools/bent_faces.h"
#include "tools/disc_radii.h"
#include "tools/hidden_points.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

// Two lattices that meet at a right angle in x = 0; z = 0 or x = 0.
std::vector<glm::dvec3> make_fold(int n) {
    std::vector<glm::dvec3> points;
    for (int i = -n; i <= n; ++i)
        for (int y = 0; y <= 2 * n; ++y) points.emplace_back(std::min(i, 0), y, std::max(i, 0));
    return points;
}

}  // namespace

TEST_CASE("of a sphere's points those before its horizon are seen") {
    const std::vector<glm::dvec3> points = tests::make_sphere(4000);
    const glm::dvec3 eye(0.0, 0.0, 4.0);
    const double horizon = 0.25;  // cos of the angle at the center: radius over distance.
    const std::vector<std::uint32_t> seen = visible_points(points, eye);
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const bool is_seen = std::ranges::binary_search(seen, p);
        CAPTURE(points[p].z);
        if (points[p].z > horizon + 0.1) CHECK(is_seen);
        if (points[p].z < horizon - 0.1) CHECK(!is_seen);
    }
}

TEST_CASE("clouds without a hull are seen whole, wherever the viewpoint is") {
    CHECK(visible_points({}, {1, 2, 3}).empty());
    const std::vector<glm::dvec3> three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    CHECK(visible_points(three, {0, 0, 0}).size() == 3);
    const std::vector<glm::dvec3> same(9, glm::dvec3(1, 2, 3));
    CHECK(visible_points(same, {1, 2, 3}).size() == 9);
    std::vector<glm::dvec3> line;
    for (int i = 0; i < 20; ++i) line.push_back({double(i), 0.0, 0.0});
    CHECK(visible_points(line, {30, 0, 0}).size() == 20);
}

TEST_CASE("discs on a lattice are as wide as half a cell's diagonal") {
    const PointSurface surface(tests::make_patch(17, 0.0, 1).points);
    for (const double radius : disc_radii(surface))
        CHECK(radius == doctest::Approx(std::sqrt(0.5) / 16.0));
}

TEST_CASE("discs cover a jittered patch") {
    const tests::Patch patch = tests::make_patch(20, 0.3, 4);
    const PointSurface surface(patch.points);
    const std::vector<double> radii = disc_radii(surface);
    for (int x = 0; x <= 200; ++x)
        for (int y = 0; y <= 200; ++y) {
            const glm::dvec3 at(x / 200.0, y / 200.0, 0.0);
            bool is_covered = false;
            for (std::size_t p = 0; p < radii.size(); ++p)
                is_covered =
                    is_covered || glm::distance(at, patch.points[p]) <= radii[p] * 1.000001;
            CAPTURE(x);
            CAPTURE(y);
            CHECK(is_covered);
        }
}

TEST_CASE("points without umbrellas have the discs that points usually have") {
    CHECK(disc_radii(PointSurface({})).empty());
    CHECK(disc_radii(PointSurface(std::vector<glm::dvec3>{{1, 2, 3}})) == std::vector<double>{0.0});
    std::vector<glm::dvec3> points = tests::make_patch(17, 0.0, 1).points;
    points.emplace_back(50.0, 50.0, 50.0);
    const PointSurface surface(points);
    REQUIRE(surface.label(PointId{17 * 17}) == PointLabel::undecided);
    CHECK(disc_radii(surface).back() == doctest::Approx(std::sqrt(0.5) / 16.0));
}

TEST_CASE("a flat point has one face and a fold's edge two, each with its triangles before it") {
    const int n = 6;
    const std::vector<glm::dvec3> points = make_fold(n);
    const PointSurface surface(points);
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const glm::dvec3& at = points[p];
        if (at.y < 2.0 || at.y > 2 * n - 2.0) continue;
        CAPTURE(p);
        const std::vector<BentFace> faces = bent_faces(surface, PointId{p});
        if (at.x <= -2.0 || at.z >= 2.0) CHECK(faces.size() == 1);
        if (at.x != 0.0 || at.z != 0.0) continue;
        REQUIRE(faces.size() == 2);
        for (const BentFace& face : faces) {
            const bool is_flat = std::abs(face.normal.z) > 0.5;
            CHECK(std::abs(is_flat ? face.normal.z : face.normal.x) > 1.0 - 1e-9);
            CHECK((is_flat ? face.middle.x : -face.middle.z) < -0.5);
        }
        CHECK(std::abs(glm::dot(faces[0].normal, faces[1].normal)) < 1e-9);
    }
}
