#include "silhouette/points/border_bend.h"

#include <doctest/doctest.h>

#include <vector>

#include "silhouette/points/point_surface.h"
#include "tests/points/sample_clouds.h"

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

}  // namespace
}  // namespace rimline
