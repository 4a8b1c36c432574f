#include "silhouette/points/border_edges.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "tests/silhouette/points/sample_clouds.h"

namespace rimline {
namespace {

// The definition: spokes of a border point with a triangle on one side alone.
bool ends_along(const PointSurface& surface, PointId from, PointId to) {
    if (surface.label(from) != PointLabel::border) return false;
    const auto range = surface.umbrellas_of(from);
    for (std::uint32_t u = range.first; u < range.last; ++u) {
        const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
        const std::size_t size = umbrella.ring.size();
        std::vector<bool> has_triangle(2 * size + 1);
        for (std::size_t j = 0; j < has_triangle.size(); ++j)
            has_triangle[j] = !umbrella.is_gap(j % size);
        for (std::size_t j = 0; j < size; ++j)
            if (umbrella.ring[j] == to && has_triangle[j + size] != has_triangle[j + size - 1])
                return true;
    }
    return false;
}

std::vector<PointEdge> by_definition(const PointSurface& surface) {
    std::vector<PointEdge> edges;
    for (std::uint32_t a = 0; a < surface.size(); ++a)
        for (std::uint32_t b = a + 1; b < surface.size(); ++b)
            if (ends_along(surface, PointId{a}, PointId{b}) &&
                ends_along(surface, PointId{b}, PointId{a}))
                edges.push_back({PointId{a}, PointId{b}});
    return edges;
}

TEST_CASE("a flat patch ends along the edges of its outline and no others") {
    for (const double amount : {0.0, 0.1, 0.25}) {
        CAPTURE(amount);
        constexpr std::uint32_t k_size = 30;
        const PointSurface surface(tests::make_patch(k_size, amount, 1).points);
        std::vector<PointEdge> outline;
        const auto add = [&](std::uint32_t a, std::uint32_t b) {
            outline.push_back({PointId{a}, PointId{b}});
        };
        for (std::uint32_t i = 0; i + 1 < k_size; ++i) {
            add(i, i + 1);
            add((k_size - 1) * k_size + i, (k_size - 1) * k_size + i + 1);
            add(i * k_size, (i + 1) * k_size);
            add(i * k_size + k_size - 1, (i + 1) * k_size + k_size - 1);
        }
        std::ranges::sort(outline);
        CHECK(border_edges(surface) == outline);
    }
}

TEST_CASE("a sphere and sets without umbrellas have no border edges") {
    CHECK(border_edges(PointSurface(tests::make_sphere(2000))).empty());
    CHECK(border_edges(PointSurface(std::vector<glm::dvec3>{})).empty());
    CHECK(border_edges(PointSurface(std::vector<glm::dvec3>{{1, 2, 3}})).empty());
}

TEST_CASE("border edges are those that both points have: ascending and each once") {
    std::vector<glm::dvec3> points = tests::make_patch(20, 0.35, 7).points;
    // A hole, and noise: not all points agree.
    std::erase_if(points, [](const glm::dvec3& p) {
        return glm::length(p - glm::dvec3(0.5, 0.5, 0.0)) < 0.15;
    });
    tests::add_noise(points, 0.005, 3);
    for (const auto method :
         {PointSurfaceOptions::Method::robust, PointSurfaceOptions::Method::thesis}) {
        PointSurfaceOptions options;
        options.method = method;
        const PointSurface surface(points, options);
        const std::vector<PointEdge> edges = border_edges(surface);
        CHECK(edges.size() > 40);
        CHECK(edges == by_definition(surface));
    }
}

}  // namespace
}  // namespace rimline
