#include "silhouette/points/crease_points.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "silhouette/points/border_edges.h"
#include "silhouette/points/feature_weights.h"
#include "silhouette/points/point_surface.h"
#include "tests/silhouette/points/sample_clouds.h"
#include "tests/silhouette/points/soundness.h"

namespace rimline {
namespace {

// The least angle of one of the point's normals with `normal`.
double error_of(const PointSurface& surface, PointId point, const glm::dvec3& normal) {
    double least = std::numbers::pi;
    const PointSurface::UmbrellaRange range = surface.umbrellas_of(point);
    for (std::uint32_t u = range.first; u < range.last; ++u)
        least =
            std::min(least, tests::angle_of_lines(surface.umbrella(UmbrellaId{u}).normal, normal));
    return least;
}

// Two half planes in rows along the y axis, where they turn by `turn`. Points are moved within their planes by up to
// `amount` of their spacing, those of the crease along it.
struct Bent {
    static constexpr int k_across = 8, k_along = 20;
    std::vector<glm::dvec3> points;
    std::vector<int> rows;  // 0: on the crease; negative on the first side.
    glm::dvec3 normals[2];  // Of the sides.

    Bent(double turn, double amount, std::uint64_t seed) {
        tests::Random random(seed);
        const auto at = [&](double x) {
            const double half = (x < 0.0 ? -0.5 : 0.5) * turn;
            return glm::dvec3(x * std::cos(half), 0.0, -std::abs(x) * std::sin(0.5 * turn));
        };
        for (int x = -k_across; x <= k_across; ++x)
            for (int y = 0; y <= k_along; ++y) {
                const double dx = amount * tests::jitter(random);
                const double dy = amount * tests::jitter(random);
                points.push_back(at(x == 0 ? 0.0 : x + dx) + glm::dvec3(0.0, y + dy, 0.0));
                rows.push_back(x);
            }
        normals[0] = {-std::sin(0.5 * turn), 0.0, std::cos(0.5 * turn)};
        normals[1] = {std::sin(0.5 * turn), 0.0, std::cos(0.5 * turn)};
    }
    bool is_inside(std::uint32_t i) const {
        return std::abs(rows[i]) < k_across - 1 && points[i].y > 2.0 && points[i].y < k_along - 2.0;
    }
};

TEST_CASE("points of a crease have the normals of both sides, and rows beside it are flat") {
    for (const double turn_deg : {40.0, 60.0, 90.0, 110.0})
        for (const double amount : {0.0, 0.1, 0.2}) {
            // Points of the other side get into stars.
            if (turn_deg > 90.0 && amount > 0.0) continue;
            CAPTURE(turn_deg);
            CAPTURE(amount);
            const Bent bent(turn_deg * tests::k_degree, amount, 11);
            const PointSurface surface(bent.points);
            tests::check_sound(surface);
            const std::vector<float> weights = feature_weights(surface);
            for (std::uint32_t i = 0; i < surface.size(); ++i) {
                if (!bent.is_inside(i)) continue;
                CAPTURE(i);
                CAPTURE(bent.rows[i]);
                const bool is_on = bent.rows[i] == 0;
                CHECK(surface.label(PointId{i}) ==
                      (is_on ? PointLabel::feature : PointLabel::interior));
                CHECK(surface.umbrellas_of(PointId{i}).size() == (is_on ? 2u : 1u));
                for (const bool second : {false, true})
                    if (is_on || second == (bent.rows[i] > 0))
                        CHECK(error_of(surface, PointId{i}, bent.normals[second]) < 1e-6);
                if (is_on)
                    CHECK(double(weights[i]) ==
                          doctest::Approx(std::min(turn_deg / 90.0, 2.0 - turn_deg / 90.0)));
                else
                    CHECK(weights[i] < 1e-5f);
            }
        }
}

constexpr int k_cube = 8;

// The lattice points of its faces.
std::vector<glm::dvec3> cube() {
    std::vector<glm::dvec3> points;
    for (int x = 0; x <= k_cube; ++x)
        for (int y = 0; y <= k_cube; ++y)
            for (int z = 0; z <= k_cube; ++z)
                if (x % k_cube == 0 || y % k_cube == 0 || z % k_cube == 0)
                    points.push_back({x, y, z});
    return points;
}

TEST_CASE("at the corner of a cube three umbrellas meet") {
    const std::vector<glm::dvec3> points = cube();
    const PointSurface surface(points);
    tests::check_sound(surface);
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        CAPTURE(i);
        std::uint32_t faces = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (std::fmod(points[i][axis], k_cube) != 0.0) continue;
            ++faces;
            glm::dvec3 normal(0.0);
            normal[axis] = 1.0;
            CHECK(error_of(surface, PointId{i}, normal) < 1e-6);
        }
        CHECK(surface.umbrellas_of(PointId{i}).size() == faces);
        CHECK(surface.label(PointId{i}) ==
              (faces > 1 ? PointLabel::feature : PointLabel::interior));
    }
}

TEST_CASE("the edges of a cube are crease edges, and no others") {
    const PointSurface surface(cube());
    std::vector<PointEdge> expected;
    for (std::uint32_t a = 0; a < surface.size(); ++a)
        for (std::uint32_t b = a + 1; b < surface.size(); ++b) {
            const glm::dvec3& p = surface.positions()[a];
            const glm::dvec3& q = surface.positions()[b];
            int common = 0;
            for (int axis = 0; axis < 3; ++axis)
                common += p[axis] == q[axis] && std::fmod(p[axis], k_cube) == 0.0;
            if (common >= 2 && glm::distance(p, q) == 1.0)
                expected.push_back({PointId{a}, PointId{b}});
        }
    CHECK(expected.size() == 12 * k_cube);
    CHECK(crease_edges(surface) == expected);
    CHECK(border_edges(surface).empty());
}

TEST_CASE("a surface that bends evenly has no crease, however few its points") {
    for (const int around : {8, 10, 12, 16}) {
        CAPTURE(around);
        std::vector<glm::dvec3> points;
        const double step = 2.0 * std::numbers::pi / around;
        for (int y = 0; y < 20; ++y)
            for (int i = 0; i < around; ++i) {
                const double angle = step * (i + (y % 2 == 0 ? 0.0 : 0.5));
                points.push_back({std::cos(angle), 0.5 * step * y, std::sin(angle)});
            }
        const PointSurface surface(points);
        CHECK(surface.count(PointLabel::feature) == 0);
        CHECK(surface.count(PointLabel::interior) > points.size() / 2);
    }
}

TEST_CASE("an edge of one point is no crease") {
    // A plane with one point lifted: its star is a pyramid.
    tests::Patch patch = tests::make_patch(15, 0.0, 1);
    patch.points[7 * 15 + 7].z = 0.07;
    const PointSurface surface(patch.points);
    CHECK(surface.count(PointLabel::feature) == 0);
}

}  // namespace
}  // namespace rimline
