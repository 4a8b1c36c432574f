#include "tools/output/page_stubble.h"

#include <doctest/doctest.h>

#include <vector>

using namespace rimline;
using tools::PageLine;

namespace {

using Places = std::vector<glm::dvec2>;

constexpr double k_stubble = 4.0, k_holding = 1.5;

PageLine piece(bool is_hidden, const Places& points, LineKind kind = LineKind::crease,
               bool is_closed = false) {
    return {.kind = kind,
            .is_hidden = is_hidden,
            .is_closed = is_closed,
            .points = points,
            .curves = {},
            .chains = {},
            .edges = {}};
}

// The lines that stay, by their first points.
Places starts_of_rest(std::vector<PageLine> lines, std::size_t first = 0) {
    tools::leave_out_hidden_stubble(lines, first, k_stubble, k_holding);
    Places left;
    for (const PageLine& line : lines) left.push_back(line.points.front());
    return left;
}

}  // namespace

TEST_CASE("a short hidden line goes where an end of it leads nowhere") {
    const PageLine outline = piece(false, {{0, 0}, {100, 0}});
    // From the outline into the model: shorter than the stubble or longer.
    CHECK(starts_of_rest({outline, piece(true, {{10, 0}, {10, 3.9}})}) == Places{{0, 0}});
    CHECK(starts_of_rest({outline, piece(true, {{10, 0}, {10, 4.1}})}) == Places{{0, 0}, {10, 0}});
    // Away from all lines, up to twice that.
    CHECK(starts_of_rest({outline, piece(true, {{10, 20}, {10, 27.9}})}) == Places{{0, 0}});
    CHECK(starts_of_rest({outline, piece(true, {{10, 20}, {10, 28.1}})}) ==
          Places{{0, 0}, {10, 20}});
    // What is seen is never taken.
    CHECK(starts_of_rest({outline, piece(false, {{10, 20}, {10, 21}})}) ==
          Places{{0, 0}, {10, 20}});
}

TEST_CASE("a short hidden line stays where both ends meet other lines") {
    const PageLine top = piece(false, {{0, 0}, {100, 0}}), below = piece(true, {{0, 3}, {100, 3}});
    CHECK(starts_of_rest({top, below, piece(true, {{10, 0}, {10, 3}})}).size() == 3);
    // Pieces of one line, with gaps between them.
    std::vector<PageLine> pieces{top};
    for (int i = 0; i < 6; ++i) pieces.push_back(piece(true, {{0, 3.0 * i}, {0, 3.0 * i + 2.0}}));
    pieces.push_back(piece(true, {{0, 18.0}, {0, 40.0}}));
    CHECK(starts_of_rest(pieces).size() == pieces.size());
    // Without what they lead to, they go one after another.
    pieces.pop_back();
    CHECK(starts_of_rest(pieces) == Places{{0, 0}});
}

TEST_CASE("a small hidden hole stays, and a small hidden contour goes") {
    const Places square{{10, 10}, {10.5, 10}, {10.5, 10.5}, {10, 10.5}};
    CHECK(starts_of_rest({piece(true, square, LineKind::crease, true)}).size() == 1);
    CHECK(starts_of_rest({piece(true, square, LineKind::border, true)}).size() == 1);
    CHECK(starts_of_rest({piece(true, square, LineKind::silhouette, true)}).empty());
}

TEST_CASE("lines of another view, before the first one, neither go nor hold others") {
    const std::vector<PageLine> lines{piece(true, {{10, 3}, {10, 5}}),
                                      piece(false, {{0, 0}, {100, 0}}),
                                      piece(true, {{10, 0}, {10, 3}})};
    CHECK(starts_of_rest(lines, 1) == Places{{10, 3}, {0, 0}});
}
