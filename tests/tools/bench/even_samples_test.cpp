#include "tools/bench/even_samples.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("even samples lie on the mesh, keep their distance, and leave no room for another") {
    const Mesh terrain(make_built_in_shape("terrain", 2000));
    const EvenSamples samples = even_samples(terrain, 1000);
    REQUIRE(samples.positions.size() == samples.is_border.size());
    CHECK(samples.positions.size() > 600);
    CHECK(samples.positions.size() < 1100);
    const auto distance_to = [&](const glm::dvec3& p, std::size_t except) {
        double nearest = 1e30;
        for (std::size_t i = 0; i < samples.positions.size(); ++i)
            if (i != except) nearest = std::min(nearest, glm::distance(samples.positions[i], p));
        return nearest;
    };
    double min = 1e30, max = 0.0;
    for (std::size_t i = 0; i < samples.positions.size(); ++i) {
        const double nearest = distance_to(samples.positions[i], i);
        min = std::min(min, nearest);
        max = std::max(max, nearest);
    }
    CHECK(max < 2.0 * min);
    for (const glm::vec3& vertex : terrain.positions())
        CHECK(distance_to(vertex, samples.positions.size()) < 1.3 * min);

    // On the border are those that lie on a border edge.
    const Mesh::EdgeRange borders = terrain.edges_of_class(EdgeClass::border);
    for (std::size_t i = 0; i < samples.positions.size(); ++i) {
        double nearest = 1e30;
        for (std::uint32_t e = borders.first; e < borders.last; ++e) {
            const auto [a, b] = terrain.edge(EdgeId{e}).vertices;
            const glm::dvec3 from(terrain.positions()[index(a)]), to(terrain.positions()[index(b)]);
            const glm::dvec3 along = to - from, p = samples.positions[i] - from;
            const double t = std::clamp(glm::dot(p, along) / glm::dot(along, along), 0.0, 1.0);
            nearest = std::min(nearest, glm::length(p - t * along));
        }
        CHECK((samples.is_border[i] != 0) == (nearest < 1e-6 * min));
    }
}

TEST_CASE("even samples are the same each time, and none of none") {
    const Mesh sphere(make_built_in_shape("sphere", 500));
    const EvenSamples samples = even_samples(sphere, 300);
    CHECK(samples.positions == even_samples(sphere, 300).positions);
    CHECK(std::ranges::count(samples.is_border, 1) == 0);
    CHECK(even_samples(sphere, 0).positions.empty());
}
