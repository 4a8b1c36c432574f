// Measures of views that are known without a device: directions, sight, choices. And light on a sphere.

#include "tools/bench/view_measures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/bench/light_measures.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

TEST_CASE("even directions have unit length and keep apart from each other") {
    const std::vector<glm::dvec3> directions = even_directions(256);
    REQUIRE(directions.size() == 256);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        CHECK(glm::length(directions[i]) == doctest::Approx(1.0));
        for (std::size_t j = 0; j < i; ++j)
            CHECK(glm::distance(directions[i], directions[j]) > 2.5 / 16.0);
    }
}

TEST_CASE(
    "a quarter of a sphere's faces is seen from twice its radius and three of a box's six sides") {
    const Mesh sphere(make_built_in_shape("sphere", 8000));
    const auto share = [](const std::vector<bool>& seen) {
        return double(std::count(seen.begin(), seen.end(), true)) / double(seen.size());
    };
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 2, 3));
    // The cap within acos(1/2) of the eye.
    CHECK(share(faces_seen(sphere, sphere.center() + 2.0 * sphere.radius() * direction)) ==
          doctest::Approx(0.25).epsilon(0.06));
    const Mesh box(make_built_in_shape("box"));
    const glm::dvec3 corner = glm::normalize(glm::dvec3(3, 4, 5));
    CHECK(share(faces_seen(box, box.center() + 2.0 * box.radius() * corner)) ==
          doctest::Approx(0.5));
}

TEST_CASE("the best candidates apart are tops first and then the best that are left") {
    const Mesh mesh(make_built_in_shape("sphere", 100));
    std::vector<glm::dvec3> eyes;
    std::vector<double> measure;
    // Along a great circle, 10 degrees apart: tops at numbers 2 and 9.
    for (int i = 0; i < 12; ++i) {
        const double angle = 0.1745329 * i;
        eyes.push_back(mesh.center() + 2.0 * glm::dvec3(std::cos(angle), std::sin(angle), 0));
        measure.push_back(i == 2 ? 10.0 : i == 9 ? 9.0 : 5.0 - 0.1 * std::abs(i - 5.2));
    }
    CHECK(best_apart(mesh, eyes, measure, 2) == std::vector<std::size_t>{2, 9});
    CHECK(best_apart(mesh, eyes, measure, 3) == std::vector<std::size_t>{2, 9, 5});
}

TEST_CASE("greedy coverage takes what shows most that is new") {
    ViewMeasures measures;
    measures.eyes.resize(3);
    measures.seen = {{true, true, true, false, false},
                     {true, true, false, true, false},
                     {false, false, false, true, true}};
    CHECK(greedy_coverage(measures, 2) == std::vector<std::size_t>{0, 2});
}

TEST_CASE("a light on a sphere leaves the share in the dark that geometry predicts" *
          doctest::test_suite("plain")) {
    const Mesh mesh(make_built_in_shape("sphere", 20000));
    const LitView view(mesh, mesh.center() + 2.0 * mesh.radius() * glm::dvec3(0, 0, 1));
    const LightMeasure front = view.measure({0, 0, 1});
    CHECK(front.away == 0.0);
    CHECK(front.unlit < 0.02);
    const LightMeasure side = view.measure({1, 0, 0});
    CHECK(side.away == doctest::Approx(0.5).epsilon(0.02));
    CHECK(side.unlit == doctest::Approx(0.5).epsilon(0.03));
    const LightMeasure back = view.measure({0, 0, -1});
    CHECK(back.away == 1.0);
    CHECK(back.contrast == 0.0);
    CHECK(side.contrast > 0.0);
}

}  // namespace
