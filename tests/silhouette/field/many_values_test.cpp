#include "silhouette/field/many_values.h"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <stop_token>
#include <vector>

namespace rimline {
namespace {

TEST_CASE("every value is computed once, and progress ascends to 1") {
    for (const std::size_t count : {0u, 1u, 33u, 5'000u, 100'000u}) {
        CAPTURE(count);
        std::vector<glm::dvec3> points(count);
        for (std::size_t i = 0; i < count; ++i) points[i].x = static_cast<double>(i);
        std::vector<double> values(count), shares;
        many_values(points, values, {{}, [&](double share) { shares.push_back(share); }},
                    [] { return [](const glm::dvec3& p) { return 2.0 * p.x; }; });
        for (std::size_t i = 0; i < count; ++i) REQUIRE(values[i] == 2.0 * static_cast<double>(i));
        CHECK(std::ranges::is_sorted(shares));
        CHECK(shares.back() == 1.0);
        CHECK(shares.size() <= 1 + std::max<std::size_t>(count / 32 + 1, 400));
    }
}

TEST_CASE("after a stop no thread begins another value") {
    const std::vector<glm::dvec3> points(1'000);
    std::vector<double> values(points.size());
    std::stop_source stop;
    std::atomic<int> computed = 0;
    const auto value = [&](const glm::dvec3&) {
        ++computed;
        stop.request_stop();
        return 0.0;
    };
    CHECK_THROWS_AS(many_values(points, values, {stop.get_token(), {}}, [&] { return value; }),
                    Error);
    CHECK(computed <= tbb::this_task_arena::max_concurrency());
}

}  // namespace
}  // namespace rimline
