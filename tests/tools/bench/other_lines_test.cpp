#include "tools/bench/other_lines.h"

#include <doctest/doctest.h>

namespace rimline::tools {
namespace {

TEST_CASE("pieces have the visibility of the nearest line of the other program") {
    const std::vector<LinePiece> pieces{
        {{0.5, 0, 0}, {}, 2.0, false}, {{1.5, 0, 0}, {}, 1.0, true}, {{0.5, 3, 0}, {}, 1.0, true}};
    const std::vector<OtherSegment> segments{{{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0)}, true},
                                             {{glm::vec3(1, 0, 0), glm::vec3(2, 0, 0)}, true}};
    const OtherErrors errors = compare_lines(pieces, segments, 0.1);
    CHECK(errors.missing_share == 0.25);
    CHECK(errors.wrong_share == doctest::Approx(1.0 / 3.0));
    CHECK(compare_lines(pieces, segments, 5.0).missing_share == 0.0);
    CHECK(compare_lines(pieces, {}, 5.0).missing_share == 1.0);
    CHECK(compare_lines(pieces, {}, 5.0).wrong_share == 0.0);
    CHECK(compare_lines({}, segments, 5.0).missing_share == 0.0);
}

}  // namespace
}  // namespace rimline::tools
