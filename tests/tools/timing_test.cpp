#include "tools/timing.h"

#include <doctest/doctest.h>

#include <vector>

namespace rimline::tools {
namespace {

TEST_CASE("a quantile is the least value that the share does not exceed") {
    const std::vector<double> values{5.0, 1.0, 4.0, 2.0, 3.0};
    CHECK(quantile(values, 0.0) == 1.0);
    CHECK(quantile(values, 0.2) == 1.0);
    CHECK(quantile(values, 0.21) == 2.0);
    CHECK(quantile(values, 0.5) == 3.0);
    CHECK(quantile(values, 0.999) == 5.0);
    CHECK(quantile(values, 1.0) == 5.0);
    CHECK(quantile({7.0}, 0.5) == 7.0);
}

}  // namespace
}  // namespace rimline::tools
