#include "tools/bench/line_pieces.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_oracle.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/skip.h"
#include "tools/bench/line_views.h"
#include "tools/bench/piece_rays.h"

namespace rimline::tools {
namespace {

// The pieces of one view of the knot, which crosses itself in the picture.
struct KnotPieces {
    const Mesh mesh{make_built_in_shape("knot", 5000)};
    const BenchView view = bench_views(mesh, 1).front();
    LineDrawing drawing;
    std::vector<LinePiece> pieces;

    KnotPieces() {
        const LineSurface surface(mesh);
        drawing =
            LineDrawer(surface).draw(view.view, brute_force_silhouette(mesh, view.view.point()),
                                     checkable({.draws = {true, true, false, false}}));
        pieces = pieces_of(mesh, drawing);
    }
};

TEST_CASE("pieces are as long as the runs together and lie on the mesh's edges") {
    const KnotPieces knot;
    double runs = 0.0, hidden_runs = 0.0, pieces = 0.0, hidden_pieces = 0.0;
    for (const LineRun& run : knot.drawing.runs) {
        runs += run.length;
        if (!run.is_visible()) hidden_runs += run.length;
    }
    for (const LinePiece& piece : knot.pieces) {
        pieces += piece.length;
        if (piece.is_hidden) hidden_pieces += piece.length;
        const auto position = [&](std::size_t k) {
            return glm::dvec3(knot.mesh.positions()[index(piece.vertices[k])]);
        };
        const double edge = glm::length(position(1) - position(0));
        CHECK(glm::length(piece.middle - position(0)) + glm::length(piece.middle - position(1)) ==
              doctest::Approx(edge));
    }
    CHECK(hidden_pieces > 0.0);
    CHECK(pieces == doctest::Approx(runs));
    CHECK(hidden_pieces == doctest::Approx(hidden_runs));
}

TEST_CASE("answers differ by the length of their pieces") {
    const std::vector<LinePiece> pieces{
        {{}, {}, 3.0, false}, {{}, {}, 1.0, true}, {{}, {}, 4.0, true}};
    CHECK(differing_length(pieces, std::vector<std::uint8_t>{0, 1, 1}).differing == 0.0);
    CHECK(differing_length(pieces, std::vector<std::uint8_t>{1, 0, 1}).differing == 4.0);
    CHECK(differing_length(pieces, std::vector<std::uint8_t>{0, 1, 0}).all == 8.0);
    CHECK(differing_length({}, {}).all == 0.0);
}

TEST_CASE("a ray a piece agrees with the drawing, and less so where more faces are left out") {
    if (!PieceRays::missing().empty()) RIMLINE_SKIP(PieceRays::missing().data());
    const KnotPieces knot;
    const PieceRays rays(knot.mesh);
    std::vector<std::uint8_t> is_hidden;
    const auto wrong_share = [&](RayWay way) {
        rays.find_hidden(knot.view.view, knot.pieces, way, is_hidden);
        REQUIRE(is_hidden.size() == knot.pieces.size());
        const DifferingLength length = differing_length(knot.pieces, is_hidden);
        return length.differing / length.all;
    };
    CHECK(wrong_share(RayWay::own_faces) < 1e-3);
    CHECK(wrong_share(RayWay::shortened) < 0.05);
    CHECK(wrong_share(RayWay::one_ring) > wrong_share(RayWay::own_faces));
}

}  // namespace
}  // namespace rimline::tools
