#include "silhouette/hough/octree_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rimline {
namespace {

struct Shape {
    std::uint32_t depth = 0;
    std::uint32_t stack = 0;  // The most that a depth-first walk holds.
    std::uint32_t greatest_leaf = 0;
};

// Checks what octree_order.h promises of any points.
Shape checked(std::span<const glm::dvec3> points, std::uint32_t bucket_size) {
    const OctreeOrder tree = octree_order(points, bucket_size);
    std::vector<std::uint32_t> numbers = tree.order;
    std::sort(numbers.begin(), numbers.end());
    REQUIRE(numbers.size() == points.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i) REQUIRE(numbers[i] == i);
    Shape shape;
    if (points.empty()) {
        REQUIRE(tree.cells.empty());
        return shape;
    }
    REQUIRE(tree.cells[0].begin == 0);
    REQUIRE(tree.cells[0].end == points.size());

    struct Visit {
        std::uint32_t cell, depth;
    };
    std::vector<Visit> stack{{0, 0}};
    std::vector<bool> seen(tree.cells.size(), false);
    while (!stack.empty()) {
        shape.stack = std::max(shape.stack, static_cast<std::uint32_t>(stack.size()));
        const Visit visit = stack.back();
        stack.pop_back();
        const OctreeCell& cell = tree.cells[visit.cell];
        REQUIRE_FALSE(seen[visit.cell]);
        seen[visit.cell] = true;
        REQUIRE(cell.begin < cell.end);
        shape.depth = std::max(shape.depth, visit.depth);
        if (cell.is_leaf()) {
            REQUIRE(cell.first_child == 0);
            shape.greatest_leaf = std::max(shape.greatest_leaf, cell.end - cell.begin);
            continue;
        }
        REQUIRE(cell.end - cell.begin > bucket_size);
        REQUIRE(cell.first_child > visit.cell);
        REQUIRE(cell.child_count >= 2);
        REQUIRE(cell.child_count <= 8);
        std::uint32_t begin = cell.begin;
        for (std::uint32_t k = 0; k < cell.child_count; ++k) {
            const OctreeCell& child = tree.cells[cell.first_child + k];
            REQUIRE(child.begin == begin);
            begin = child.end;
            stack.push_back({cell.first_child + k, visit.depth + 1});
        }
        REQUIRE(begin == cell.end);
    }
    REQUIRE(std::ranges::all_of(seen, [](bool s) { return s; }));
    REQUIRE(shape.depth <= k_octree_max_depth);
    REQUIRE(shape.stack <= k_octree_max_stack);
    return shape;
}

std::vector<glm::dvec3> random_points(std::uint32_t count, double scale, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(-scale, scale);
    std::vector<glm::dvec3> points(count);
    for (glm::dvec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
    return points;
}

TEST_CASE("distinct points fill leaves no fuller than the bucket") {
    for (const std::uint32_t count : {0u, 1u, 2u, 16u, 17u, 5000u})
        for (const std::uint32_t bucket_size : {1u, 3u, 16u}) {
            CAPTURE(count);
            CAPTURE(bucket_size);
            CHECK(checked(random_points(count, 1.0, 41), bucket_size).greatest_leaf <= bucket_size);
        }
}

TEST_CASE("octants order space: points of different root octants are in different children") {
    const std::vector<glm::dvec3> points = random_points(2000, 1.0, 42);
    const OctreeOrder tree = octree_order(points, 16);
    REQUIRE(tree.cells[0].child_count == 8);
    // The bounding cube's middle is that of the points within their own spacing.
    for (std::uint32_t k = 0; k < 8; ++k) {
        const OctreeCell& child = tree.cells[1 + k];
        const glm::dvec3 sign(k & 4 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 1 ? 1.0 : -1.0);
        for (std::uint32_t i = child.begin; i < child.end; ++i)
            for (int axis = 0; axis < 3; ++axis)
                REQUIRE(sign[axis] * points[tree.order[i]][axis] > -0.01);
    }
}

TEST_CASE("any number of coincident points share one leaf") {
    std::vector<glm::dvec3> points(10000, glm::dvec3(0.25, -3.0, 1e-30));
    CHECK(checked(points, 16).greatest_leaf == 10000);
    points.emplace_back(0.25, -3.0, 1.0);
    const Shape shape = checked(points, 16);
    CHECK(shape.greatest_leaf == 10000);
    CHECK(shape.depth == 1);
}

TEST_CASE("a stray point does not blunt the rest") {
    std::vector<glm::dvec3> points = random_points(3000, 1e-9, 43);
    points.emplace_back(1e6, 0.0, 0.0);
    const Shape shape = checked(points, 16);
    CHECK(shape.greatest_leaf <= 16);
    CHECK(shape.depth <= 10);  // No chain of single children on the way down.
}

TEST_CASE("points that halve their distance for ever stay within the depth") {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 1000; ++i) {
        points.emplace_back(std::ldexp(1.0, -i), 0.0, 0.0);
        for (int octant = 1; octant < 8; ++octant)
            points.emplace_back(std::ldexp(octant & 1, -i), std::ldexp(octant >> 1 & 1, -i),
                                std::ldexp(octant >> 2, -i));
    }
    CHECK(checked(points, 1).depth >= 50);
}

TEST_CASE("flat and straight sets of points are as good as any") {
    std::vector<glm::dvec3> points = random_points(2000, 1.0, 44);
    for (glm::dvec3& p : points) p.y = 0.5;
    CHECK(checked(points, 4).greatest_leaf <= 4);
    for (glm::dvec3& p : points) p.z = -2.0;
    CHECK(checked(points, 4).greatest_leaf <= 4);
}

TEST_CASE("the extremes of what is allowed do not overflow") {
    CHECK(checked(random_points(500, 0x1p62, 45), 2).greatest_leaf <= 2);
    CHECK(checked(random_points(500, 0x1p-500, 46), 2).greatest_leaf <= 2);
    std::vector<glm::dvec3> subnormal;
    for (int i = 0; i < 100; ++i) subnormal.emplace_back(i * 4.9406564584124654e-324, 0.0, 0.0);
    CHECK(checked(subnormal, 2).greatest_leaf <= 2);
}

}  // namespace
}  // namespace rimline
