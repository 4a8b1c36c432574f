#include "silhouette/points/thesis_umbrellas.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <vector>

#include "silhouette/points/point_order.h"
#include "silhouette/points/point_surface.h"
#include "tests/silhouette/points/sample_clouds.h"

namespace rimline {
namespace {

struct Found {
    OrderedPoints points;
    NeighborLists neighbors;
    UmbrellaSet umbrellas;

    explicit Found(const std::vector<glm::dvec3>& positions,
                   const PointSurfaceOptions& options = {})
        : points(order_points(positions)),
          neighbors(points.positions, options.k, {}),
          umbrellas(find_thesis_umbrellas(points.positions, neighbors, options, {})) {}

    std::size_t place(std::uint32_t point) const {
        return static_cast<std::size_t>(std::ranges::find(points.numbers, point) -
                                        points.numbers.begin());
    }
    PointLabel label(std::uint32_t point) const { return umbrellas.labels[place(point)]; }
    std::vector<std::uint32_t> ring(std::uint32_t point) const {
        const std::size_t i = place(point);
        const Fan& fan = umbrellas.fans[i];
        std::vector<std::uint32_t> ring;
        for (std::size_t j = 0; j < fan.size; ++j)
            ring.push_back(
                points.numbers[neighbors.of(static_cast<std::uint32_t>(i))[fan.ring[j]]]);
        std::ranges::sort(ring);
        return ring;
    }
    std::uint32_t count(PointLabel label) const {
        return static_cast<std::uint32_t>(std::ranges::count(umbrellas.labels, label));
    }
};

// Half a cube's surface: three faces of a lattice of n x n cells.
std::vector<glm::dvec3> make_corner(int n) {
    std::vector<glm::dvec3> points;
    for (int x = 0; x <= n; ++x)
        for (int y = 0; y <= n; ++y)
            for (int z = 0; z <= n; ++z)
                if (x == 0 || y == 0 || z == 0) points.emplace_back(x, y, z);
    return points;
}

TEST_CASE("all umbrellas are of the k nearest neighbors alone") {
    std::vector<glm::dvec3> points = tests::make_patch(30, 0.4, 5).points;
    tests::add_noise(points, 0.01, 6);
    // A denser region, so that many points are neighbors of others that are none of theirs.
    for (const glm::dvec3& p : tests::make_patch(30, 0.4, 7).points)
        points.push_back(0.2 * p + glm::dvec3(0.4, 0.4, 0.0));
    const Found found(points);
    std::size_t followers = 0;
    for (std::uint32_t i = 0; i < found.points.positions.size(); ++i) {
        followers += found.neighbors.of(i).size() - found.neighbors.nearest_count();
        const Fan& fan = found.umbrellas.fans[i];
        for (std::size_t j = 0; j < fan.size; ++j)
            CHECK(fan.ring[j] < found.neighbors.nearest_count());
    }
    for (const UmbrellaSet::Supplement& supplement : found.umbrellas.supplements)
        for (std::size_t j = 0; j < supplement.fan.size; ++j)
            CHECK(supplement.fan.ring[j] < found.neighbors.nearest_count());
    REQUIRE(followers > 100);
}

TEST_CASE("the edges of a corner of a cube are creases, its outline is the border") {
    const std::vector<glm::dvec3> points = make_corner(12);
    const Found found(points);
    // By how many coordinates are 0, of those that are not on the outline.
    std::uint32_t edges = 0, wrong = 0;
    for (std::uint32_t i = 0; i < found.points.numbers.size(); ++i) {
        const glm::dvec3 p = points[found.points.numbers[i]];
        const int zeros = (p.x == 0.0) + (p.y == 0.0) + (p.z == 0.0);
        const bool is_outline = std::max({p.x, p.y, p.z}) == 12.0;
        const PointLabel label = found.umbrellas.labels[i];
        if (is_outline) {
            wrong += label != PointLabel::border;
        } else if (zeros >= 2) {
            ++edges;
            wrong += label != PointLabel::feature;
        } else {
            wrong += label != PointLabel::interior;
        }
    }
    CHECK(edges == 34);
    CHECK(wrong == 0);
}

TEST_CASE(
    "a point whose Gabriel triangle is not trusted has umbrellas about its neighbors' normals") {
    // A stray point above the one in the middle is its nearest neighbor. Without it the triangle is trusted.
    // Fewer than half of the neighbors lie within 20 degrees of an upright plane.
    PointSurfaceOptions options;
    options.omega = glm::radians(20.0);
    std::vector<glm::dvec3> points = tests::make_patch(13, 0.1, 3).points;
    const std::uint32_t middle = 6 * 13 + 6;
    const Found flat(points, options);
    points.push_back(points[middle] + glm::dvec3(0.0, 0.0, 0.4 / 12));
    const Found found(points, options);
    CHECK(found.label(middle) == PointLabel::interior);
    CHECK(found.ring(middle) == flat.ring(middle));
}

TEST_CASE("where no Gabriel triangle is trusted, no point has an umbrella") {
    // In a volume. The Gabriel triangle itself would be an umbrella.
    tests::Random random(8);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 300; ++i)
        points.push_back({tests::jitter(random), tests::jitter(random), tests::jitter(random)});
    PointSurfaceOptions options;
    options.omega = 0.02;
    options.omega_t = 0.01;
    const Found found(points, options);
    CHECK(found.count(PointLabel::undecided) == 300);
}

TEST_CASE("the third pass leaves fewer boundary edges that are not returned") {
    std::vector<glm::dvec3> points = tests::make_patch(60, 0.45, 9).points;
    tests::add_noise(points, 0.002, 4);
    PointSurfaceOptions options;
    options.method = PointSurfaceOptions::Method::thesis;
    // 209 with it, 351 without.
    CHECK(PointSurface(points, options).inconsistent_edge_count() < 250);
}

// The saddle of the thesis's Table 5.1, a surface with 256 border points. None is missed there, and none extra.
TEST_CASE("a saddle has its outline for border, no more and no less") {
    std::vector<glm::dvec3> points;
    for (int x = -32; x <= 32; ++x)
        for (int y = -32; y <= 32; ++y)
            points.emplace_back(x / 32.0, y / 32.0, (x * x - y * y) / 1024.0);
    const Found found(points);
    CHECK(found.count(PointLabel::border) == 256);
    std::uint32_t missed = 0;
    for (std::uint32_t i = 0; i < found.points.numbers.size(); ++i) {
        const glm::dvec3 p = points[found.points.numbers[i]];
        missed += std::max(std::abs(p.x), std::abs(p.y)) == 1.0 &&
                  found.umbrellas.labels[i] != PointLabel::border;
    }
    CHECK(missed == 0);
}

}  // namespace
}  // namespace rimline
