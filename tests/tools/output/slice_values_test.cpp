#include "tools/output/slice_values.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

using namespace rimline;
using namespace rimline::tools;

namespace {

std::vector<double> exact(const SliceGrid& grid, double (*f)(const glm::dvec3&)) {
    std::vector<double> values;
    for (const glm::dvec3& point : grid.points()) values.push_back(f(point));
    return values;
}

SliceValues asked(const SliceGrid& grid, double tolerance, double (*f)(const glm::dvec3&)) {
    return slice_values(grid, tolerance,
                        [&](std::span<const glm::dvec3> points, std::span<double> out,
                            const LongCall&) { std::ranges::transform(points, out.begin(), f); });
}

double greatest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::abs(a[i] - b[i]));
    return greatest;
}

double cubic(const glm::dvec3& p) {
    return 1.0 + p.x * p.x * p.y - 2.0 * p.z * p.z * p.z + 3.0 * p.x * p.y * p.z + p.z;
}
double wave(const glm::dvec3& p) { return std::sin(3.0 * p.x + p.y) * std::cos(2.0 * p.z - p.y); }
// As the vote of a plane is, smooth but for its second derivative.
double bend(const glm::dvec3& p) { return std::pow(std::max(p.y + 0.3 * p.z + 0.17, 0.0), 2.0); }

}  // namespace

TEST_CASE("a slice of a cubic has its values, with an eighth of the sums") {
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {512, 37, 16, 3, 1}) {
            CAPTURE(axis);
            CAPTURE(side);
            const SliceGrid grid(axis, 0.2, 0.5, 3.0, side);
            const SliceValues found = asked(grid, 1e-9, cubic);
            CHECK(greatest_difference(found.values, exact(grid, cubic)) < 1e-10);
            CHECK(found.greatest_error < 1e-10);
            if (side == 512) CHECK(found.sums < grid.points().size() / 6);
        }
}

TEST_CASE("values of a slice are within the tolerance, and a smaller one needs more sums") {
    const SliceGrid grid(0, 0.2, 0.0, 3.0, 200);
    std::size_t sums = 0;
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
        CAPTURE(tolerance);
        for (const auto f : {wave, bend}) {
            const SliceValues found = asked(grid, tolerance, f);
            CHECK(greatest_difference(found.values, exact(grid, f)) <= tolerance);
            CHECK(found.greatest_error <= 0.5 * tolerance);
        }
        const std::size_t needed = asked(grid, tolerance, wave).sums;
        CHECK(needed >= sums);
        sums = needed;
    }
    CHECK(sums > grid.points().size());  // Then all blocks are asked, and the knots.
    // Only along the line where it begins to bend.
    CHECK(asked(grid, 1e-6, bend).sums < grid.points().size() / 3);
}

TEST_CASE("without a tolerance each square is asked") {
    const SliceGrid grid(1, 0.0, 0.0, 2.0, 50);
    const SliceValues found = asked(grid, 0.0, bend);
    CHECK(found.values == exact(grid, bend));
    CHECK(found.sums == grid.points().size());
    const SliceGrid empty(1, 5.0, 0.0, 2.0, 50);
    CHECK(asked(empty, 0.1, bend).values.empty());
}
