#include "silhouette/mesh/straightest_pairs.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using WayPairs = std::vector<std::pair<std::size_t, std::size_t>>;

template <typename Way>
WayPairs pairs_of(const std::vector<Way>& ways, double max_cos) {
    WayPairs pairs;
    StraightestPairs().each(std::span<const Way>(ways), max_cos,
                            [&](std::size_t i, std::size_t j) { pairs.emplace_back(i, j); });
    return pairs;
}

// By the definition, one pair after the other.
template <typename Way>
WayPairs pairs_by_scan(const std::vector<Way>& ways, double max_cos) {
    WayPairs pairs;
    std::vector<bool> is_taken(ways.size(), false);
    for (;;) {
        double least = 2.0;
        std::pair<std::size_t, std::size_t> best;
        for (std::size_t i = 0; i < ways.size(); ++i)
            for (std::size_t j = i + 1; j < ways.size(); ++j)
                if (const double cos = glm::dot(ways[i], ways[j]);
                    !is_taken[i] && !is_taken[j] && cos <= max_cos && cos < least)
                    least = cos, best = {i, j};
        if (least == 2.0) return pairs;
        is_taken[best.first] = is_taken[best.second] = true;
        pairs.push_back(best);
    }
}

std::vector<glm::dvec2> spread_around(std::size_t count) {
    std::vector<glm::dvec2> ways;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * double(i) / double(count);
        ways.emplace_back(std::cos(angle), std::sin(angle));
    }
    return ways;
}

TEST_CASE("the straightest pairs are those of a scan, also where many are alike") {
    tests::Random random(5);
    for (std::size_t count = 0; count < 40; ++count)
        for (const double max_cos : {-0.7, 0.5}) {
            CAPTURE(count);
            std::vector<glm::dvec3> ways;
            for (std::size_t i = 0; i < count; ++i) {
                // Some of them from a grid, so that pairs are equal.
                const glm::dvec3 way =
                    i % 2 == 0 ? glm::dvec3(random.signed_unit(), random.signed_unit(),
                                            random.signed_unit())
                               : glm::dvec3(random.between(-1, 1), random.between(-1, 1), 1.0);
                ways.push_back(glm::normalize(way));
            }
            CHECK(pairs_of(ways, max_cos) == pairs_by_scan(ways, max_cos));
            const std::vector<glm::dvec2> around = spread_around(count);
            CHECK(pairs_of(around, max_cos) == pairs_by_scan(around, max_cos));
        }
}

TEST_CASE("ways that are no numbers are in no pair") {
    const glm::dvec2 none(std::numeric_limits<double>::quiet_NaN());
    CHECK(pairs_of<glm::dvec2>({none, {1, 0}, none, {-1, 0}, none}, -0.5) == WayPairs{{1, 3}});
}

TEST_CASE("where very many lines meet none is paired") {
    const std::size_t max = StraightestPairs::k_max_ways;
    CHECK(pairs_of(spread_around(max), -0.7).size() == max / 2);
    CHECK(pairs_of(spread_around(max + 1), -0.7).empty());
    StraightestPairs straightest;
    const std::vector<glm::dvec2> many = spread_around(1'000'000);
    straightest.each(std::span<const glm::dvec2>(many), -0.7, [](std::size_t, std::size_t) {});
    CHECK(straightest.pairs() == 0);
}

}  // namespace
}  // namespace rimline
