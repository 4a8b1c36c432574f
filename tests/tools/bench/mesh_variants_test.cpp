#include "tools/bench/mesh_variants.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

TEST_CASE("noise moves every vertex by the share of the radius and is the same for the same seed") {
    const Mesh mesh(make_built_in_shape("torus", 1000));
    const MeshSource noisy = with_noise(mesh, 1e-3, 7);
    REQUIRE(noisy.positions.size() == mesh.vertex_count());
    glm::dvec3 sum(0.0);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const glm::dvec3 move = glm::dvec3(noisy.positions[v]) - glm::dvec3(mesh.positions()[v]);
        CHECK(glm::length(move) == doctest::Approx(1e-3 * mesh.radius()).epsilon(1e-3));
        sum += move;
    }
    CHECK(glm::length(sum) / mesh.vertex_count() < 2e-4 * mesh.radius());
    CHECK(with_noise(mesh, 1e-3, 7).positions == noisy.positions);
    CHECK(with_noise(mesh, 1e-3, 8).positions != noisy.positions);
}

TEST_CASE("a bent bar is an arc whose ends point apart by the angle") {
    // Along z, the longest extent perpendicular to y.
    MeshSource bar;
    for (int i = 0; i <= 40; ++i)
        for (const float x : {-0.1f, 0.1f}) bar.positions.emplace_back(x, 0.3f, 0.1f * float(i));
    for (std::uint32_t i = 0; i < 40; ++i) {
        bar.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
        bar.triangles.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
    }
    const MeshSource arc = bent(Mesh(bar), {0, 1, 0}, 90.0);
    const auto spine = [&](std::size_t i) {
        return 0.5 * (glm::dvec3(arc.positions[2 * i]) + glm::dvec3(arc.positions[2 * i + 1]));
    };
    double length = 0.0;
    for (std::size_t i = 0; i < 40; ++i) {
        length += glm::distance(spine(i), spine(i + 1));
        CHECK(arc.positions[2 * i].y == doctest::Approx(0.3));
    }
    CHECK(length == doctest::Approx(4.0).epsilon(1e-3));
    const glm::dvec3 first = glm::normalize(spine(1) - spine(0));
    const glm::dvec3 last = glm::normalize(spine(40) - spine(39));
    CHECK(glm::degrees(std::acos(glm::dot(first, last))) == doctest::Approx(90.0).epsilon(0.03));
}

}  // namespace
