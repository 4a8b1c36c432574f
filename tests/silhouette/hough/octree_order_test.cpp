#include "silhouette/hough/octree_order.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <stop_token>

#include "silhouette/error.h"

namespace rimline {
namespace {

void check_permutation(std::span<const std::uint32_t> order, std::size_t count) {
    std::vector<std::uint32_t> numbers(order.begin(), order.end());
    std::sort(numbers.begin(), numbers.end());
    REQUIRE(numbers.size() == count);
    for (std::uint32_t i = 0; i < numbers.size(); ++i) REQUIRE(numbers[i] == i);
}

std::vector<glm::dvec3> random_points(std::uint32_t count, double scale, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(-scale, scale);
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = 0; i < count; ++i)
        points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    return points;
}

double mean_step(std::span<const glm::dvec3> points, std::span<const std::uint32_t> order) {
    double sum = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i)
        sum += glm::length(points[order[i]] - points[order[i - 1]]);
    return sum / static_cast<double>(order.size() - 1);
}

// The points of a grid in any order; walked along a Hilbert curve, each is next to the one before.
std::vector<glm::dvec3> grid(std::uint32_t side, std::uint64_t seed) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t x = 0; x < side; ++x)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t z = 0; z < side; ++z) points.emplace_back(x, y, z);
    std::shuffle(points.begin(), points.end(), std::mt19937_64(seed));
    return points;
}

TEST_CASE("the order of a grid steps from neighbor to neighbor") {
    for (const std::uint32_t side : {2u, 4u, 16u}) {
        CAPTURE(side);
        const std::vector<glm::dvec3> points = grid(side, 41);
        const std::vector<std::uint32_t> order = octree_order(points);
        check_permutation(order, points.size());
        for (std::size_t i = 1; i < order.size(); ++i)
            REQUIRE(glm::length(points[order[i]] - points[order[i - 1]]) == 1.0);
    }
}

TEST_CASE("every octant is one run, and every octant of it") {
    const std::vector<glm::dvec3> points = random_points(5000, 1.0, 42);
    const std::vector<std::uint32_t> order = octree_order(points);
    glm::dvec3 low(1.0);
    glm::dvec3 high(-1.0);
    for (const glm::dvec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 size = high - low;
    const double side = std::max({size.x, size.y, size.z});
    for (const double cells : {2.0, 4.0, 8.0}) {
        CAPTURE(cells);
        const auto cell_of = [&](std::uint32_t i) {
            const glm::dvec3 at = glm::floor((points[i] - low) / side * cells);
            return (at.x * cells + at.y) * cells + at.z;
        };
        std::vector<double> runs;
        for (const std::uint32_t i : order)
            if (runs.empty() || runs.back() != cell_of(i)) runs.push_back(cell_of(i));
        // No cell comes twice, but for single points on the far faces of the cube.
        std::vector<double> distinct = runs;
        std::sort(distinct.begin(), distinct.end());
        distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
        CHECK(runs.size() <= distinct.size() + 6);
    }
}

TEST_CASE("points that coincide stay in the order of their numbers") {
    std::vector<glm::dvec3> points(1000, glm::dvec3(0.25, -3.0, 7.0));
    std::vector<std::uint32_t> order = octree_order(points);
    CHECK(std::is_sorted(order.begin(), order.end()));
    check_permutation(order, points.size());
    points.emplace_back(0.0, 0.0, 0.0);
    order = octree_order(points);
    check_permutation(order, points.size());
    order.erase(std::find(order.begin(), order.end(), 1000u));
    CHECK(std::is_sorted(order.begin(), order.end()));
}

TEST_CASE("a stray point does not blunt the rest") {
    std::vector<glm::dvec3> points = grid(8, 43);
    points.emplace_back(0x1p40, 0x1p40, -0x1p40);
    std::vector<std::uint32_t> order = octree_order(points);
    check_permutation(order, points.size());
    order.erase(std::find(order.begin(), order.end(), 512u));
    CHECK(mean_step(points, order) < 1.01);
}

TEST_CASE("smaller sizes come first, and each size in the order of its own points") {
    const std::vector<glm::dvec3> points = random_points(3000, 2.0, 44);
    std::vector<std::uint8_t> sizes;
    for (std::uint32_t i = 0; i < points.size(); ++i)
        sizes.push_back(static_cast<std::uint8_t>(i % 7 == 0 ? 255 : i % 2));
    const std::vector<std::uint32_t> order = octree_order(points, sizes);
    check_permutation(order, points.size());
    for (std::size_t i = 1; i < order.size(); ++i) REQUIRE(sizes[order[i - 1]] <= sizes[order[i]]);
    CHECK(mean_step(points, order) < 0.6);  // Any order: about 2.
}

TEST_CASE("points that halve their distance for ever are all there") {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 1000; ++i) points.emplace_back(std::ldexp(1.0, -i), 0.0, 0.0);
    check_permutation(octree_order(points), points.size());
}

TEST_CASE("the extremes of what is allowed do not overflow") {
    std::vector<glm::dvec3> points;
    for (const double size : {0x1p62, 0x1p-1022, 0x1p-1070})
        for (const double sign : {-1.0, 1.0}) points.emplace_back(sign * size, size, -sign * size);
    points.emplace_back(0.0, 0.0, 0.0);
    check_permutation(octree_order(points), points.size());
    CHECK(octree_order({}).empty());
    CHECK(octree_order(std::vector<glm::dvec3>(1)).size() == 1);
}

TEST_CASE("the order does not depend on the number of threads") {
    const std::vector<glm::dvec3> points = random_points(100000, 1.0, 45);
    const std::vector<std::uint32_t> order = octree_order(points);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(octree_order(points) == order);
}

TEST_CASE("ordering stops where that is asked") {
    const std::vector<glm::dvec3> points = random_points(100000, 1.0, 46);
    std::stop_source stop;
    CHECK(octree_order(points, {}, stop.get_token()) == octree_order(points));
    stop.request_stop();
    CHECK_THROWS_AS(octree_order(points, {}, stop.get_token()), Error);
}

}  // namespace
}  // namespace rimline
