#include "tools/bench/perturbed_points.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

PointTruth sphere() { return point_truth(Mesh(make_built_in_shape("sphere", 8000))); }

}  // namespace

TEST_CASE("without an amount the points are the vertices") {
    const PointTruth truth = sphere();
    const PerturbedPoints points = perturb(truth, {});
    CHECK(points.positions == truth.positions);
    for (std::uint32_t i = 0; i < points.vertices.size(); ++i) CHECK(points.vertices[i] == i);
}

TEST_CASE("noise moves every coordinate by its share of the vertex's edges") {
    const PointTruth truth = sphere();
    const PerturbedPoints points = perturb(truth, {.noise = 0.1});
    double squares = 0.0, spacings = 0.0;
    for (std::uint32_t i = 0; i < truth.positions.size(); ++i) {
        const glm::dvec3 d = points.positions[i] - truth.positions[i];
        squares += glm::dot(d, d) / 3.0;
        double lengths = 0.0;
        for (const std::uint32_t n : truth.neighbors[i])
            lengths += glm::distance(truth.positions[i], truth.positions[n]);
        const double spacing = 0.1 * lengths / double(truth.neighbors[i].size());
        spacings += spacing * spacing;
    }
    CHECK(std::sqrt(squares / spacings) == doctest::Approx(1.0).epsilon(0.03));
    CHECK(perturb(truth, {.noise = 0.1}).positions == points.positions);
}

TEST_CASE("outliers come last, all over a box a tenth wider on each side") {
    const PointTruth truth = sphere();
    const std::size_t count = truth.positions.size();
    const PerturbedPoints points = perturb(truth, {.outliers = 0.25});
    REQUIRE(points.positions.size() == count + count / 4);
    glm::dvec3 low = truth.positions[0], high = low;
    for (const glm::dvec3& p : truth.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 margin = 0.1 * (high - low);
    glm::dvec3 mean(0.0);
    for (std::size_t i = count; i < points.positions.size(); ++i) {
        CHECK(points.vertices[i] == PerturbedPoints::k_none);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(points.positions[i][axis] >= low[axis] - margin[axis]);
            CHECK(points.positions[i][axis] <= high[axis] + margin[axis]);
        }
        mean += points.positions[i] / double(count / 4);
    }
    CHECK(glm::distance(mean, 0.5 * (low + high)) < 0.06 * glm::length(high - low));
}

TEST_CASE("uneven points thin out along the longest axis") {
    PointTruth truth = sphere();
    for (glm::dvec3& p : truth.positions) p.y *= 2.0;
    const PerturbedPoints points = perturb(truth, {.uneven = 0.8});
    double high = 0.0;
    for (const glm::dvec3& p : truth.positions) high = std::max(high, p.y);
    int kept[2]{}, all[2]{};
    for (const glm::dvec3& p : truth.positions)
        if (std::abs(p.y) > 0.8 * high) ++all[p.y > 0.0];
    for (std::size_t i = 0; i < points.positions.size(); ++i) {
        CHECK(points.positions[i] == truth.positions[points.vertices[i]]);
        if (std::abs(points.positions[i].y) > 0.8 * high) ++kept[points.positions[i].y > 0.0];
    }
    // On the low end a twentieth of 0.8 is left out on average, on the high end the rest of it.
    CHECK(kept[0] > 0.9 * all[0]);
    CHECK(kept[1] < 0.35 * all[1]);
    CHECK(kept[1] > 0.1 * all[1]);
}
