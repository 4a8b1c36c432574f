#include "tools/bench/pass_medians.h"

#include <doctest/doctest.h>

namespace rimline::tools {
namespace {

TEST_CASE("times of passes are medians over frames, and sums are medians of a frame's sums") {
    PassMedians medians;
    CHECK(medians.each().empty());
    CHECK(medians.sum_ms("") == 0.0);
    medians.add({});  // A frame without times does not count.
    for (const double ms : {5.0, 1.0, 3.0}) {
        FrameReport report;
        report.passes = {{"surfaces, unlit", ms}, {"lines", 10.0 - ms}, {"surfaces, light 0", 1.0}};
        medians.add(report);
    }
    const std::vector<PassTime> each = medians.each();
    REQUIRE(each.size() == 3);
    CHECK(each[0].name == "surfaces, unlit");
    CHECK(each[0].time_ms == 3.0);
    CHECK(each[1].time_ms == 7.0);
    CHECK(medians.sum_ms("surfaces") == 4.0);
    CHECK(medians.sum_ms("lines") == 7.0);
    CHECK(medians.sum_ms("") == 11.0);
    CHECK(medians.sum_ms("resolve") == 0.0);
}

}  // namespace
}  // namespace rimline::tools
