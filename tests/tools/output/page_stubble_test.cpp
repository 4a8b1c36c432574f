#include "tools/output/page_stubble.h"

#include <doctest/doctest.h>

#include <vector>

#include "tests/tools/output/made_page_line.h"

using namespace rimline;
using tests::page_line;
using tools::PageLine;

namespace {

using Places = std::vector<glm::dvec2>;

constexpr double k_stubble = 4.0, k_holding = 1.5;

// The lines that stay, by their first points.
Places starts_of_rest(std::vector<PageLine> lines, std::size_t first = 0) {
    tools::leave_out_hidden_stubble(lines, first, k_stubble, k_holding);
    Places left;
    for (const PageLine& line : lines) left.push_back(line.points.front());
    return left;
}

}  // namespace

TEST_CASE("a short hidden line goes where an end of it leads nowhere") {
    const PageLine outline = page_line(false, {{0, 0}, {100, 0}});
    // From the outline into the model: shorter than the stubble or longer.
    CHECK(starts_of_rest({outline, page_line(true, {{10, 0}, {10, 3.9}})}) == Places{{0, 0}});
    CHECK(starts_of_rest({outline, page_line(true, {{10, 0}, {10, 4.1}})}) ==
          Places{{0, 0}, {10, 0}});
    // Away from all lines, up to twice that.
    CHECK(starts_of_rest({outline, page_line(true, {{10, 20}, {10, 27.9}})}) == Places{{0, 0}});
    CHECK(starts_of_rest({outline, page_line(true, {{10, 20}, {10, 28.1}})}) ==
          Places{{0, 0}, {10, 20}});
    // What is seen is never taken.
    CHECK(starts_of_rest({outline, page_line(false, {{10, 20}, {10, 21}})}) ==
          Places{{0, 0}, {10, 20}});
}

TEST_CASE("a short hidden line stays where both ends meet other lines") {
    const PageLine top = page_line(false, {{0, 0}, {100, 0}}),
                   below = page_line(true, {{0, 3}, {100, 3}});
    CHECK(starts_of_rest({top, below, page_line(true, {{10, 0}, {10, 3}})}).size() == 3);
    // Pieces of one line, with gaps between them.
    std::vector<PageLine> pieces{top};
    for (int i = 0; i < 6; ++i)
        pieces.push_back(page_line(true, {{0, 3.0 * i}, {0, 3.0 * i + 2.0}}));
    pieces.push_back(page_line(true, {{0, 18.0}, {0, 40.0}}));
    CHECK(starts_of_rest(pieces).size() == pieces.size());
    // Without what they lead to, they go one after another.
    pieces.pop_back();
    CHECK(starts_of_rest(pieces) == Places{{0, 0}});
}

TEST_CASE("a small hidden hole stays, and a small hidden contour goes") {
    const Places square{{10, 10}, {10.5, 10}, {10.5, 10.5}, {10, 10.5}};
    CHECK(starts_of_rest({page_line(true, square, true, LineKind::crease)}).size() == 1);
    CHECK(starts_of_rest({page_line(true, square, true, LineKind::border)}).size() == 1);
    CHECK(starts_of_rest({page_line(true, square, true, LineKind::silhouette)}).empty());
}

TEST_CASE("lines of another view, before the first one, neither go nor hold others") {
    const std::vector<PageLine> lines{page_line(true, {{10, 3}, {10, 5}}),
                                      page_line(false, {{0, 0}, {100, 0}}),
                                      page_line(true, {{10, 0}, {10, 3}})};
    CHECK(starts_of_rest(lines, 1) == Places{{10, 3}, {0, 0}});
}
