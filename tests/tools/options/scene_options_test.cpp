#include "tools/options/scene_options.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace rimline::tools {
namespace {

TEST_CASE("a sun over a ground stands at least 15 degrees high, and else where it was chosen") {
    const glm::dvec3 up(0.0, 0.0, 2.0);
    const double least = std::sin(15.0 * std::numbers::pi / 180.0);
    const glm::dvec3 high(3.0, 0.0, 1.0);
    CHECK(above_ground(high, up) == high);
    for (const glm::dvec3& low :
         {glm::dvec3(1, 0, 0.1), glm::dvec3(1, 2, -3), glm::dvec3(-1, 0.5, 0)}) {
        const glm::dvec3 lifted = above_ground(low, up);
        CHECK(glm::length(lifted) == doctest::Approx(1.0));
        CHECK(lifted.z == doctest::Approx(least));
        // Straight up from there.
        CHECK(lifted.x * low.y == doctest::Approx(lifted.y * low.x));
        CHECK(lifted.x * low.x + lifted.y * low.y > 0.0);
    }
    CHECK(above_ground({0, 0, -1}, up).z == doctest::Approx(least));
}

}  // namespace
}  // namespace rimline::tools
