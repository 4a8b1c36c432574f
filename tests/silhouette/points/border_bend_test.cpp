#include "silhouette/points/border_bend.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "silhouette/points/border_tracing.h"
#include "silhouette/points/point_surface.h"
#include "tests/silhouette/points/sample_clouds.h"

namespace rimline {
namespace {

using Points = std::vector<glm::dvec3>;

TEST_CASE("the bend through a corner is twice that past it, and through a saw tooth six times") {
    const Points corner{{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
    CHECK(bend_through(corner, 0, 1, 2, 3, 4) == doctest::Approx(2.0).epsilon(1e-5));
    CHECK(bend_through(corner, 4, 3, 2, 1, 0) == doctest::Approx(2.0).epsilon(1e-5));
    // Where only one side is known there is one turn less past it.
    CHECK(bend_through(corner, {}, 1, 2, 3, 4) == doctest::Approx(4.0).epsilon(1e-5));
    CHECK(bend_through(corner, 0, 1, 2, 3, {}) == doctest::Approx(4.0).epsilon(1e-5));
    for (const double height : {0.1, 0.5, 1.5}) {
        const Points teeth{{0, 0, 0}, {1, height, 0}, {2, 0, 0}, {3, height, 0}, {4, 0, 0}};
        CHECK(bend_through(teeth, 0, 1, 2, 3, 4) == doctest::Approx(6.0).epsilon(1e-3));
    }
    // The turns do not depend on the plane.
    const Points tilted{{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {0, 0.6, 0.8}, {0, 1.2, 1.6}};
    CHECK(bend_through(tilted, 0, 1, 2, 3, 4) == doctest::Approx(2.0).epsilon(1e-5));
}

// A lattice whose lowest row has one point moved back by `depth` spacings.
Points make_notched(std::uint32_t n, double depth) {
    Points points;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const bool is_notch = y == 0 && x == n / 2;
            points.push_back({x, is_notch ? depth : y, 0.0});
        }
    return points;
}

TEST_CASE("a point that stands back from a straight border is inside") {
    for (const double depth : {0.2, 0.35, 0.5}) {
        CAPTURE(depth);
        const Points points = make_notched(16, depth);
        const PointSurface surface(points);
        for (std::uint32_t i = 0; i < surface.size(); ++i) {
            const glm::dvec3& p = points[i];
            const bool is_outline = p.x == 0 || p.x == 15 || p.y == 0 || p.y == 15;
            CHECK((surface.label(PointId{i}) == PointLabel::border) == is_outline);
            CHECK(surface.label(PointId{i}) <= PointLabel::interior);
        }
    }
}

// A border along x, points 0 to 7 or the other way round, each with points of its own around it, between the one
// that follows and the one before. Whether each is left on it.
std::vector<bool> straighten(const Points& border, bool is_reversed) {
    constexpr std::uint32_t k_points = 8, k_own = 4;
    const auto number = [&](std::uint32_t i) { return is_reversed ? k_points - 1 - i : i; };
    Points points(k_points * (1 + k_own));
    for (std::uint32_t i = 0; i < k_points; ++i) {
        points[number(i)] = border[i];
        const auto angle_to = [&](std::uint32_t other) {
            const glm::dvec3 d = border[other] - border[i];
            return std::atan2(d.y, d.x);
        };
        const double begin = i + 1 < k_points ? angle_to(i + 1) : 0.0;
        double turn = (i > 0 ? angle_to(i - 1) : std::numbers::pi) - begin;
        if (turn < 0.0) turn += 2.0 * std::numbers::pi;
        for (std::uint32_t n = 0; n < k_own; ++n) {
            const double angle = begin + turn * (n + 1) / (k_own + 1);
            points[k_points + k_own * i + n] =
                border[i] + 0.3 * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
        }
    }
    const NeighborLists neighbors(points, static_cast<std::uint32_t>(points.size()) - 1, {});
    std::vector<OpenPoint> open;
    for (std::uint32_t n = 0; n < k_points; ++n) {
        const std::uint32_t i = number(n);
        if (i == 0 || i == k_points - 1) continue;
        OpenPoint point{n, {}, {}, OpenPoint::Verdict::border};
        const auto add = [&](std::uint32_t other) {
            const auto list = neighbors.of(n);
            point.fan.ring[point.fan.size++] =
                static_cast<std::uint8_t>(std::ranges::find(list, other) - list.begin());
        };
        add(number(i + 1));
        for (std::uint32_t own = 0; own < k_own; ++own) add(k_points + k_own * i + own);
        add(number(i - 1));
        point.fan.open(k_own + 1);
        open.push_back(point);
    }
    straighten_borders(points, neighbors, open);
    std::vector<bool> is_left(k_points, true);
    for (const OpenPoint& point : open)
        is_left[number(point.point)] = point.verdict == OpenPoint::Verdict::border;
    return is_left;
}

TEST_CASE("who stands back from a border is taken off whichever way its points are numbered") {
    tests::Random random(4);
    int taken_off = 0;
    for (int n = 0; n < 3000; ++n) {
        CAPTURE(n);
        Points border;
        for (int i = 0; i < 8; ++i)
            border.push_back({i + tests::jitter(random), 0.5 * tests::jitter(random), 0.0});
        const std::vector<bool> is_left = straighten(border, false);
        taken_off += static_cast<int>(std::ranges::count(is_left, false));
        CHECK(is_left == straighten(border, true));
    }
    CHECK(taken_off > 300);
}

}  // namespace
}  // namespace rimline
