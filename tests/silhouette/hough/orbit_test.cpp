#include "silhouette/hough/orbit.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <numbers>

namespace rimline {
namespace {

TEST_CASE("an orbit starts at the first axis in its plane and turns counter-clockwise about up") {
    const glm::dvec3 center(10.0, 20.0, 30.0);
    struct Expected {
        glm::dvec3 up, start, quarter;
    };
    for (const Expected& e :
         {Expected{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, Expected{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
          Expected{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Expected{{0, -3, 0}, {1, 0, 0}, {0, 0, 1}}}) {
        const Orbit orbit(center, e.up, 2.0);
        CHECK(glm::distance(orbit.position(0.0), center + 2.0 * e.start) == 0.0);
        CHECK(glm::distance(orbit.position(0.5 * std::numbers::pi), center + 2.0 * e.quarter) <
              1e-15 * 40.0);
    }
}

TEST_CASE("an orbit keeps its radius and its plane, oblique axes included") {
    const glm::dvec3 center(-1.0, 2.0, 0.5);
    for (const glm::dvec3& up : {glm::dvec3(0, 2, 0), glm::dvec3(1, 1, 1), glm::dvec3(0, 1, -4),
                                 glm::dvec3(1, 1e-6, 1e-6), glm::dvec3(1e-9, 1e-9, 3e-9)}) {
        const Orbit orbit(center, up, 3.0);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 offset = orbit.position(0.1 * i) - center;
            CHECK(glm::length(offset) == doctest::Approx(3.0).epsilon(1e-14));
            CHECK(glm::dot(offset, glm::normalize(up)) ==
                  doctest::Approx(0.0).scale(1).epsilon(1e-14));
        }
    }
}

TEST_CASE("an orbit's viewpoint is its position rounded once") {
    const Orbit orbit({0.1, 0.2, 0.3}, {0, 1, 0}, 1.7);
    const glm::dvec3 p = orbit.position(1.0);
    const HomogeneousPoint v = orbit.viewpoint(1.0);
    CHECK(v.x == static_cast<float>(p.x));
    CHECK(v.y == static_cast<float>(p.y));
    CHECK(v.z == static_cast<float>(p.z));
    CHECK(v.w == 1.0f);
}

}  // namespace
}  // namespace rimline
