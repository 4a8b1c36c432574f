#include "tools/output/drawing_page.h"

#include <doctest/doctest.h>

#include <array>

#include "silhouette/error.h"
#include "tools/command.h"

using namespace rimline;
using tools::DrawingPage;
using tools::LinePage;
using tools::ViewCell;
using tools::ViewPlace;

namespace {

void check_place(const glm::dvec2& a, const glm::dvec2& b) {
    CHECK(a.x == doctest::Approx(b.x));
    CHECK(a.y == doctest::Approx(b.y));
}

DrawingPage place_one(const LinePage& paper, const glm::dvec2& low, const glm::dvec2& high) {
    const ViewCell cell{low, high};
    return tools::place_views(paper, {&cell, 1});
}

}  // namespace

TEST_CASE("a picture fills the page between its margins and y points downwards there") {
    LinePage paper;
    paper.size_mm = {120.0, 320.0};
    const DrawingPage page = place_one(paper, {-1.0, 2.0}, {3.0, 4.0});
    const ViewPlace place = page.views.at(0);
    CHECK(place.mm_per_unit == doctest::Approx(25.0));
    check_place(place.to_mm({-1.0, 4.0}), {10.0, 135.0});
    check_place(place.to_mm({3.0, 2.0}), {110.0, 185.0});
}

TEST_CASE("a picture without width or height is as large as the other side allows") {
    const LinePage paper;
    const ViewPlace upright = place_one(paper, {2.0, 0.0}, {2.0, 1.0}).views.at(0);
    CHECK(upright.mm_per_unit == doctest::Approx(277.0));
    check_place(upright.to_mm({2.0, 0.0}), {105.0, 287.0});
    CHECK(place_one(paper, {0.0, 5.0}, {1.0, 5.0}).views.at(0).mm_per_unit ==
          doctest::Approx(190.0));
    CHECK_THROWS_AS(place_one(paper, {1.0, 1.0}, {1.0, 1.0}), Error);
}

TEST_CASE("a page without a size is as large as its drawing") {
    LinePage paper;
    paper.size_mm.reset();
    paper.margin_mm = 15.0;
    check_place(place_one(paper, {0.0, 0.0}, {1.0, 3.0}).size_mm, {80.0, 180.0});
    paper.mm_per_unit = 200.0;
    const DrawingPage page = place_one(paper, {0.0, 0.0}, {1.0, 3.0});
    check_place(page.size_mm, {230.0, 630.0});
    check_place(page.views.at(0).origin_mm, {15.0, 615.0});
    paper.mm_per_unit = 2000.0;
    CHECK_THROWS_AS(place_one(paper, {0.0, 0.0}, {1.0, 3.0}), tools::UsageError);
}

TEST_CASE(
    "a drawing to scale that is too large for the page is refused and one that just fits is not") {
    LinePage paper;
    paper.mm_per_unit = 19.0;
    CHECK(place_one(paper, {0.0, 0.0}, {10.0, 5.0}).views.at(0).mm_per_unit == 19.0);
    CHECK_THROWS_AS(place_one(paper, {0.0, 0.0}, {10.1, 5.0}), tools::UsageError);
    paper.margin_mm = 105.0;
    CHECK_THROWS_AS(place_one(paper, {0.0, 0.0}, {10.0, 5.0}), tools::UsageError);
}

TEST_CASE("views of one column and of one row are aligned and stand a margin apart") {
    LinePage paper;
    paper.size_mm = {300.0, 400.0};
    // A block of 4 x 2 x 1 from the front, above and the right, and a view that is larger than its neighbors.
    const std::array<ViewCell, 4> cells{{{{-2.0, -1.0}, {2.0, 1.0}, 1, 1},
                                         {{-2.0, -0.5}, {2.0, 0.5}, 1, 0},
                                         {{-0.5, -1.0}, {0.5, 1.0}, 2, 1},
                                         {{-1.5, -1.5}, {1.5, 1.5}, 2, 0}}};
    const DrawingPage page = tools::place_views(paper, cells);
    const double scale = page.views[0].mm_per_unit;
    CHECK(scale == doctest::Approx((280.0 - 10.0) / 7.0));  // Widths 4 and 3, and a gap.
    for (const ViewPlace& place : page.views) CHECK(place.mm_per_unit == scale);
    CHECK(page.views[0].origin_mm.x == doctest::Approx(page.views[1].origin_mm.x));
    CHECK(page.views[0].origin_mm.y == doctest::Approx(page.views[2].origin_mm.y));
    CHECK(page.views[1].origin_mm.y == doctest::Approx(page.views[3].origin_mm.y));
    CHECK(page.views[3].to_mm({0.0, -1.5}).y + 10.0 ==
          doctest::Approx(page.views[0].to_mm({0.0, 1.0}).y));
    CHECK(page.views[0].to_mm({2.0, 0.0}).x + 10.0 ==
          doctest::Approx(page.views[3].to_mm({-1.5, 0.0}).x));
}
