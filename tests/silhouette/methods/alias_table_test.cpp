#include "silhouette/methods/alias_table.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace rimline {
namespace {

TEST_CASE("numbers are drawn as often as their weights say") {
    std::mt19937_64 random_weight(1);
    for (const std::size_t count : {1u, 2u, 3u, 50u}) {
        CAPTURE(count);
        std::vector<double> weights(count);
        for (double& weight : weights)
            weight = std::exp(std::uniform_real_distribution<double>(-3.0, 3.0)(random_weight));
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        const AliasTable table(weights);
        RandomBits random(2);
        std::vector<std::uint32_t> drawn(count, 0);
        constexpr std::uint32_t k_draws = 1u << 20;
        for (std::uint32_t i = 0; i < k_draws; ++i) ++drawn[table.draw(random)];
        for (std::size_t i = 0; i < count; ++i) {
            CAPTURE(i);
            const double expected = weights[i] / sum * k_draws;
            // Five standard deviations.
            CHECK(std::abs(drawn[i] - expected) <= 5.0 * std::sqrt(expected) + 1.0);
        }
    }
}

TEST_CASE("an empty table reports that it is empty") {
    CHECK(AliasTable().is_empty());
    CHECK(AliasTable(std::vector<double>{}).is_empty());
    CHECK_FALSE(AliasTable(std::vector<double>{1.0}).is_empty());
}

TEST_CASE("random bits are those of SplitMix64") {
    // The authors' reference values, from seed 1234567.
    RandomBits random(1234567);
    CHECK(random.next() == 6457827717110365317u);
    CHECK(random.next() == 3203168211198807973u);
    CHECK(random.next() == 9817491932198370423u);
}

}  // namespace
}  // namespace rimline
