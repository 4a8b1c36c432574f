#include "engine/measure/occluder_clusters.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

namespace rimline {
namespace {

TEST_CASE("runs are joined over the smallest gaps, and hold all that they held") {
    constexpr std::uint32_t k_run_seed = 7;
    CAPTURE(k_run_seed);
    std::mt19937 random(k_run_seed);
    for (int round = 0; round < 200; ++round) {
        CAPTURE(round);
        std::vector<IndexRun> runs;
        std::uint32_t end = 0;
        const std::uint32_t count = 1 + std::uint32_t(random() % 60);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t first = end + 48 * (1 + std::uint32_t(random() % 5));
            end = first + 48 * (1 + std::uint32_t(random() % 9));
            runs.push_back({first, end - first});
        }
        for (const std::size_t most : {std::size_t{1}, std::size_t{7}, std::size_t{64}}) {
            std::vector<IndexRun> joined = runs;
            join_runs(joined, most);
            CHECK(joined.size() <= std::min(most, runs.size()));
            if (runs.size() <= most) CHECK(joined.size() == runs.size());
            // Each of the runs in one of the joined, which begin and end with one.
            std::size_t at = 0;
            std::uint32_t smallest_left = ~0u, largest_joined = 0;
            for (std::size_t j = 0; j < joined.size(); ++j) {
                const std::uint32_t joined_end = joined[j].first + joined[j].count;
                REQUIRE(at < runs.size());
                CHECK(joined[j].first == runs[at].first);
                if (j > 0) {
                    const std::uint32_t gap =
                        joined[j].first - (joined[j - 1].first + joined[j - 1].count);
                    smallest_left = std::min(smallest_left, gap);
                }
                std::uint32_t last_end = joined[j].first;
                for (; at < runs.size() && runs[at].first < joined_end; ++at) {
                    largest_joined = std::max(largest_joined, runs[at].first - last_end);
                    last_end = runs[at].first + runs[at].count;
                }
                CHECK(last_end == joined_end);
            }
            CHECK(at == runs.size());
            CHECK(largest_joined < smallest_left);
        }
    }
    std::vector<IndexRun> none;
    join_runs(none, 1);
    CHECK(none.empty());
}

}  // namespace
}  // namespace rimline
