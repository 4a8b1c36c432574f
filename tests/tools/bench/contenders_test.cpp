#include "tools/bench/contenders.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace rimline::tools {
namespace {

TEST_CASE("timing takes every contender in turn, the first round to warm up and count") {
    const std::vector<HomogeneousPoint> points(5, HomogeneousPoint::viewpoint({1, 2, 3}));
    std::vector<char> order;
    const auto contender = [&](char name, std::size_t every) {
        return Contender{.name = std::string(1, name),
                         .step = [&order, name](const HomogeneousPoint&) { order.push_back(name); },
                         .counters =
                             [] {
                                 return TraversalCounters{1, 2, 4};
                             },
                         .prepare = [&order] { order.push_back('('); },
                         .own_counts =
                             [&order] {
                                 return std::vector<NamedCount>{{"steps", order.size()}};
                             },
                         .every = every};
    };
    const std::vector<Contender> contenders{contender('a', 1), contender('b', 2)};
    const std::vector<Times> times = time_in_turn(contenders, points, 1, "", {});
    CHECK(std::string(order.begin(), order.end()) == "(aaaaa(bbb(aaaaa(bbb");
    CHECK(times[0].us.size() == 5);
    CHECK(times[1].us.size() == 3);
    CHECK(times[0].mean_work().edge_checks == 4);
    CHECK(times[0].own_counts[0].mean == (2 + 3 + 4 + 5 + 6) / 5.0);
    for (const double us : times[0].us) CHECK((us >= 0.0 && us < 1e6));
}

}  // namespace
}  // namespace rimline::tools
