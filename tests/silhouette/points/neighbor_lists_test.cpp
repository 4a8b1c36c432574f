#include "silhouette/points/neighbor_lists.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string>

#include "tests/silhouette/points/sample_clouds.h"

namespace rimline {
namespace {

using tests::jitter;
using tests::Random;

std::vector<glm::dvec3> make_lattice(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y)
            for (std::uint32_t x = 0; x < nx; ++x) points.push_back({x, y, z});
    return points;
}

// n along each of six rows, which bend by `bend` radians a unit; 0.1 apart, the rows 1 apart.
std::vector<glm::dvec3> make_rows(std::uint32_t n, double bend) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t row = 0; row < 6; ++row)
        for (std::uint32_t i = 0; i < n; ++i) {
            const double along = 0.1 * i;
            points.push_back(bend == 0.0 ? glm::dvec3(along, row, 0)
                                         : glm::dvec3(std::sin(bend * along) / bend, row,
                                                      (1.0 - std::cos(bend * along)) / bend));
        }
    return points;
}

std::map<std::string, std::vector<glm::dvec3>> make_clouds() {
    std::map<std::string, std::vector<glm::dvec3>> clouds;
    Random random(71);
    for (std::uint32_t i = 0; i < 400; ++i)
        clouds["random"].push_back({jitter(random), jitter(random), jitter(random)});
    clouds["plane lattice"] = make_lattice(20, 21, 1);
    clouds["lattice"] = make_lattice(7, 8, 9);
    clouds["patch"] = tests::make_patch(20, 0.3, 72).points;
    clouds["rows"] = make_rows(70, 0.0);
    clouds["few"] = make_lattice(3, 1, 1);
    clouds["one"] = make_lattice(1, 1, 1);
    clouds["none"] = {};
    // Sixty points count the one in the middle among their own.
    clouds["ball"] = {glm::dvec3(0.0)};
    for (const glm::dvec3& p : tests::make_sphere(60)) clouds["ball"].push_back(p);
    return clouds;
}

// All others, by distance and number.
std::vector<std::uint32_t> sorted_others(std::span<const glm::dvec3> points, std::uint32_t point) {
    std::vector<std::pair<double, std::uint32_t>> others;
    for (std::uint32_t j = 0; j < points.size(); ++j) {
        const glm::dvec3 d = points[point] - points[j];
        if (j != point) others.push_back({glm::dot(d, d), j});
    }
    std::ranges::sort(others);
    std::vector<std::uint32_t> numbers;
    for (const auto& [square, number] : others) numbers.push_back(number);
    return numbers;
}

TEST_CASE("a point's list is its nearest, ties by number, and whoever counts it among its own") {
    for (const auto& [name, points] : make_clouds()) {
        CAPTURE(name);
        std::vector<std::vector<std::uint32_t>> others;
        for (std::uint32_t i = 0; i < points.size(); ++i)
            others.push_back(sorted_others(points, i));
        for (const std::uint32_t k : {4u, 8u, 16u, 32u}) {
            CAPTURE(k);
            const NeighborLists lists(points, k, {});
            const std::uint32_t nearest =
                points.empty() ? 0 : std::min(k, static_cast<std::uint32_t>(points.size()) - 1);
            REQUIRE(lists.nearest_count() == nearest);
            const auto counts = [&](std::uint32_t i, std::uint32_t j) {
                return std::ranges::find(others[i].begin(), others[i].begin() + nearest, j) !=
                       others[i].begin() + nearest;
            };
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                CAPTURE(i);
                std::vector<std::uint32_t> expected;
                bool is_mutual = false;
                const bool is_row = lists.spanning_count(i) > nearest;
                for (std::uint32_t n = 0; n < others[i].size(); ++n) {
                    const bool is_counted = counts(others[i][n], i);
                    is_mutual |= n < nearest && is_counted;
                    if (n < nearest || is_row || is_counted) expected.push_back(others[i][n]);
                }
                if (expected.size() > k_max_neighbors) expected.resize(k_max_neighbors);
                const std::span<const std::uint32_t> found = lists.of(i);
                CHECK(std::ranges::equal(found, expected));
                CHECK(lists.is_mutual(i) == is_mutual);
            }
        }
    }
}

// Islands of about as many points as neighbors are asked for, on fine lattices: of many a point the nearest
// of the point before are all there are, and the farthest of both is one.
TEST_CASE("a nearest point is found where it is known to be just as far") {
    constexpr std::uint32_t k = 16;
    Random random(12);
    for (int cloud = 0; cloud < 1000; ++cloud) {
        CAPTURE(cloud);
        std::vector<glm::dvec3> points;
        const double step = 0.002 + 0.002 * std::abs(jitter(random));
        for (int island = random.between(3, 6); island > 0; --island) {
            const glm::dvec3 center{jitter(random), jitter(random), jitter(random)};
            for (std::uint32_t i = 0; i <= k; ++i) {
                const auto cell = [&] { return step * random.between(-2, 2); };
                const glm::dvec3 p = center + glm::dvec3(cell(), cell(), cell());
                if (std::ranges::find(points, p) == points.end()) points.push_back(p);
            }
        }
        const NeighborLists lists(points, k, {});
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            CAPTURE(i);
            const std::vector<std::uint32_t> others = sorted_others(points, i);
            CHECK(std::ranges::equal(lists.of(i).first(k), std::span(others).first(k)));
        }
    }
}

TEST_CASE("who lies in a row, straight or bent, has more neighbors, and no other has") {
    constexpr std::uint32_t k_along = 70;
    for (const double bend : {0.0, 0.1, 0.4}) {
        CAPTURE(bend);
        const std::vector<glm::dvec3> points = make_rows(k_along, bend);
        const NeighborLists lists(points, 16, {});
        // At its ends a row's other points are as far away as the next row.
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const bool is_end = i % k_along < 3 || i % k_along >= k_along - 3;
            CAPTURE(i);
            CHECK(lists.spanning_count(i) == (is_end ? 16 : k_max_neighbors));
        }
    }
    for (const std::vector<glm::dvec3>& points :
         {make_lattice(20, 21, 1), tests::make_patch(20, 0.3, 73).points,
          tests::make_sphere(400)}) {
        const NeighborLists lists(points, 16, {});
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            CAPTURE(i);
            CHECK(lists.spanning_count(i) == 16);
        }
    }
}

}  // namespace
}  // namespace rimline
