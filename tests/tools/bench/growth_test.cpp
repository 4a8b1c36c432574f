#include "tools/bench/growth.h"

#include <doctest/doctest.h>

#include <vector>

#include "tests/tools/bench/made_results.h"

namespace rimline::tools {
namespace {

TEST_CASE("the octree overtakes between sizes, on a straight line of the logarithms") {
    const auto step = [](std::uint32_t faces, double extraction) {
        return GrowthStep{result_of(faces, extraction, 2.0), 0};
    };
    const auto at = [](const std::vector<GrowthStep>& steps) {
        return overtaken_at(steps, &ModelResult::extraction);
    };
    CHECK(*at({step(100, 0.5), step(10'000, 2.0)}) == doctest::Approx(1000.0));
    CHECK(*at({step(100, 2.0), step(1000, 0.5), step(4000, 2.0)}) == doctest::Approx(2000.0));
    CHECK(*at({step(100, 1.5), step(1000, 2.0)}) == 100.0);
    CHECK_FALSE(at({step(100, 2.0), step(1000, 0.9)}).has_value());
    CHECK(*overtaken_at({step(100, 0.5)}, &ModelResult::update) == 100.0);
}

}  // namespace
}  // namespace rimline::tools
