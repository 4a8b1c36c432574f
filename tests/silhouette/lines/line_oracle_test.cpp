#include "silhouette/lines/line_oracle.h"

#include <doctest/doctest.h>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/against_oracle.h"

namespace rimline {
namespace {

TEST_CASE("the oracle finds a run of wrong visibility and a missing line") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    const LineView view = tests::view_of(mesh, {1, 2, 3}, false);
    const LineDrawing drawing =
        drawer.draw(view, brute_force_silhouette(mesh, view.point()), checkable({}));
    REQUIRE(check_lines(mesh, view, drawing, 1e-3).first_difference.empty());

    LineDrawing wrong = drawing;
    wrong.runs[wrong.runs.size() / 2].hidden_by += 1;
    const LineCheck found = check_lines(mesh, view, wrong, 1e-3);
    CHECK(found.wrong > 0);
    CHECK(found.missing_edges == 0);
    CHECK(!found.first_difference.empty());

    // The first in the order of the runs, whichever thread found it.
    const auto first_wrong = [&](std::size_t step) {
        LineDrawing all = drawing;
        const std::size_t first = all.runs.size() / 3;
        for (std::size_t run = first; run < all.runs.size(); run += step)
            all.runs[run].hidden_by += 1;
        return check_lines(mesh, view, all, 1e-3).first_difference;
    };
    CHECK(!first_wrong(1).empty());
    CHECK(first_wrong(1) == first_wrong(drawing.runs.size()));

    LineDrawing missing = drawing;
    missing.runs.pop_back();
    CHECK(check_lines(mesh, view, missing, 1e-3).missing_edges > 0);
}

}  // namespace
}  // namespace rimline
