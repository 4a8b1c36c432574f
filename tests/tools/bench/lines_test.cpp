#include "tools/bench/lines.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/tools/bench/quiet_context.h"
#include "tools/bench/piece_rays.h"

namespace rimline::tools {
namespace {

TEST_CASE("drawings of a shape are checked and then timed") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const LinesResult result =
        bench_lines("knot", mesh, {.views = 3, .rounds = 1, .measures_others = false}, k_quiet);
    CHECK(result.difference.empty());
    CHECK(result.check.samples > 0);
    CHECK(result.check.wrong == 0);
    CHECK(result.wrong_share() == 0.0);
    CHECK(result.drawing.ms.size() == 3);
    CHECK(result.drawing.median_ms() > 0.0);
    CHECK(result.drawing.worst_ms() >= result.drawing.median_ms());
    CHECK(result.shaped.ms.size() == 3);
    CHECK(result.extraction.ms.size() == 3);
    CHECK(result.pieces >= result.work.lines);
    CHECK(result.rays.size() == (PieceRays::missing().empty() ? 3 : 0));
    for (const RayResult& rays : result.rays) CHECK(rays.times.ms.size() == 3);
    REQUIRE(result.whole);
    CHECK(result.whole->text_bytes > 0);
}

TEST_CASE("nothing is timed where the oracle finds a line of wrong visibility") {
    // An edge of the second face goes through the first one. Who does not look for that draws the whole edge
    // either visible or hidden.
    MeshSource source;
    source.positions = {{-2, -2, 0}, {2, -2, 0}, {0, 3, 0}, {0, -1, -1}, {0, 1, -1}, {0, 0.2f, 1}};
    source.triangles = {{0, 1, 2}, {3, 4, 5}};
    const Mesh mesh(source);
    LinesBenchOptions options{.views = 3, .rounds = 1, .measures_others = false};
    CHECK(bench_lines("two faces", mesh, options, k_quiet).difference.empty());
    options.contacts = LineSurface::Contacts::none;
    const LinesResult result = bench_lines("two faces", mesh, options, k_quiet);
    CHECK_FALSE(result.difference.empty());
    CHECK(result.check.wrong > 0);
    CHECK(result.wrong_share() > 0.0);
    CHECK(result.drawing.ms.empty());
    CHECK(result.rays.empty());
    CHECK_FALSE(result.whole);
}

}  // namespace
}  // namespace rimline::tools
