#include "tools/bench/lines_targets.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

#include "tests/tools/bench/made_line_results.h"

namespace rimline::tools {
namespace {

TEST_CASE("the three meshes of the table have times of their own, which fail nothing") {
    for (const auto& [faces, median_ms] :
         {std::pair{k_bunny_faces, 2.0}, std::pair{k_igea_faces, 8.0},
          std::pair{k_large_faces, 30.0}}) {
        CHECK(std::ranges::all_of(targets_of(line_result_of(faces, median_ms, 1.0)),
                                  &Target::is_reached));
        const std::vector<Target> slow = targets_of(line_result_of(faces, 1.01 * median_ms, 1.0));
        CHECK_FALSE(std::ranges::all_of(slow, &Target::is_reached));
        CHECK(first_missed(slow).empty());
    }
    CHECK(targets_of(line_result_of(1000, 50.0, 1.0)).size() == 2);
    LinesResult igea = line_result_of(k_igea_faces, 8.0, 1.0);
    igea.drawing.ms.back() = 16.1;
    CHECK_FALSE(std::ranges::all_of(targets_of(igea), &Target::is_reached));
    igea.drawing.ms.back() = 16.0;
    CHECK(std::ranges::all_of(targets_of(igea), &Target::is_reached));
    igea.whole->all_ms = 80.1;
    CHECK_FALSE(std::ranges::all_of(targets_of(igea), &Target::is_reached));
}

TEST_CASE("a drawing may take twice the time of the rays, and nothing is compared without rays") {
    CHECK(first_missed(targets_of(line_result_of(1000, 1.0, 0.5))).empty());
    LinesResult slow = line_result_of(1000, 1.0, 0.49);
    CHECK(first_missed(targets_of(slow)) == "a ray a piece over drawing");
    slow.rays.clear();
    CHECK(first_missed(targets_of(slow)).empty());
    slow.check.wrong = 1;
    CHECK(first_missed(targets_of(slow)) == "samples of wrong count");
}

}  // namespace
}  // namespace rimline::tools
