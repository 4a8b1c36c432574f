#include "silhouette/lines/line_simplify.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

std::vector<LinePoint> random_walk(std::uint64_t seed, std::size_t count) {
    tests::Random random(seed);
    std::vector<LinePoint> points;
    glm::dvec2 at(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back({.position = at, .depth = 0.0, .arc = 0.0});
        at += glm::dvec2(1.0 + random.signed_unit(), random.signed_unit());
    }
    return points;
}

double distance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    const double share = square > 0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - a - share * way);
}

TEST_CASE("no point moves by more than the tolerance and the ends stay") {
    std::vector<std::uint32_t> kept;
    for (const double tolerance : {0.0, 0.1, 1.0, 100.0}) {
        const std::vector<LinePoint> points = random_walk(7, 500);
        simplify(points, tolerance, kept);
        REQUIRE(kept.size() >= 2);
        CHECK(kept.front() == 0);
        CHECK(kept.back() == points.size() - 1);
        CHECK(std::is_sorted(kept.begin(), kept.end()));
        for (std::size_t k = 0; k + 1 < kept.size(); ++k)
            for (std::uint32_t i = kept[k]; i <= kept[k + 1]; ++i)
                REQUIRE(distance(points[i].position, points[kept[k]].position,
                                 points[kept[k + 1]].position) <= tolerance);
    }
    CHECK(kept.size() == 2);
}

TEST_CASE("a comb takes about as long as another line" * doctest::test_suite("plain")) {
    const auto time = [](const std::vector<LinePoint>& points, std::vector<std::uint32_t>& kept) {
        const auto begin = std::chrono::steady_clock::now();
        simplify(points, 0.1, kept);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    std::vector<LinePoint> comb;
    for (int i = 0; i < 100000; ++i)
        comb.push_back({.position = {0.5 * i, i % 4 < 2 ? 0.0 : 3.0}, .depth = 0.0, .arc = 0.0});
    std::vector<std::uint32_t> kept;
    const double walk_s = time(random_walk(3, comb.size()), kept);
    const double comb_s = time(comb, kept);
    CHECK(comb_s < 50.0 * walk_s);
    // Nothing can be left out of it.
    CHECK(kept.size() == comb.size());
}

TEST_CASE("lines of no and one point stay") {
    std::vector<std::uint32_t> kept{1, 2, 3};
    simplify({}, 1.0, kept);
    CHECK(kept.empty());
    simplify(random_walk(1, 1), 1.0, kept);
    CHECK(kept.size() == 1);
}

}  // namespace
}  // namespace rimline
