// Which lines are drawn, and the faces in front of them, against exact arithmetic. Nothing is left undecided but
// pieces of lines that are shorter than a float can tell.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_oracle.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/exact/exact_numbers.h"
#include "tests/silhouette/exact/hard_classes.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using namespace rimline::tests;

// Shares of a drawing's points are floats: a shorter piece of an edge is not known.
constexpr double k_shortest_piece = 1e-6;

struct LineTotals {
    std::uint64_t views = 0, pieces = 0, checked_pieces = 0, short_pieces = 0, hidden_pieces = 0,
                  silhouettes = 0;
};

struct Amount {
    std::size_t class_step;   // Of the classes, every class_step-th one.
    std::size_t view_pieces;  // At most so many pieces of lines a view are checked, evenly chosen.
};

class ExactView {
public:
    ExactView(const Mesh& mesh, const LineView& view)
        : mesh_(mesh), eye_(view.point()), faces_(eye_) {
        for (const glm::vec3& p : mesh.positions()) vertices_.push_back(whole(p));
        for (const Triangle& t : mesh.triangles())
            faces_.add({vertex(t[0]), vertex(t[1]), vertex(t[2])});
    }

    std::uint32_t faces_before(EdgeId edge, double share) const {
        const auto& [v, w] = mesh_.edge(edge).vertices;
        return faces_.count_before(point_between(vertex(v), vertex(w), share));
    }

    // Whether the third corners of an edge's two faces lie on one side of it in the picture. A face without an area
    // has no side.
    enum class Contour { yes, no, unknown };
    Contour contour(EdgeId edge) const {
        const auto& [v, w] = mesh_.edge(edge).vertices;
        int sides = 0;
        for (const FaceId face : mesh_.faces_of(edge))
            for (const VertexId corner : mesh_.triangles()[index(face)])
                if (corner != v && corner != w) {
                    const int side = eye_.side(vertex(v), vertex(w), vertex(corner));
                    if (side == 0) return Contour::unknown;
                    sides += side;
                }
        return sides != 0 ? Contour::yes : Contour::no;
    }

private:
    const WholePoint& vertex(VertexId v) const { return vertices_[index(v)]; }

    const Mesh& mesh_;
    WholeEye eye_;
    WholeFaces faces_;
    std::vector<WholePoint> vertices_;
};

void check_drawing(const Mesh& mesh, const LineView& view, const LineDrawing& drawing,
                   std::size_t most_pieces, LineTotals& totals) {
    CHECK(drawing.report.undecided_lines == 0);
    const ExactView exact(mesh, view);
    const std::size_t step = drawing.points.size() / most_pieces + 1;
    std::size_t number = 0;
    std::vector<double> drawn(mesh.edge_count(), 0.0);
    for (const LineRun& run : drawing.runs)
        for (std::uint32_t i = run.first_point; i + 1 < run.last_point; ++i) {
            const LineSource &from = drawing.sources[i], &to = drawing.sources[i + 1];
            if (from.edge != to.edge || from.edge == k_no_edge) continue;
            const double length = std::abs(double{to.share} - double{from.share});
            drawn[index(from.edge)] += length;
            if (length < k_shortest_piece) {
                totals.short_pieces += length > 0.0 ? 1 : 0;
                continue;
            }
            ++totals.pieces;
            if (number++ % step != 0) continue;
            ++totals.checked_pieces;
            const double share = 0.5 * (double{from.share} + double{to.share});
            CAPTURE(index(from.edge));
            CAPTURE(share);
            CAPTURE(length);
            totals.hidden_pieces += run.is_visible() ? 0 : 1;
            CHECK(run.hidden_by == exact.faces_before(from.edge, share));
        }
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const EdgeId edge{e};
        const std::size_t faces = mesh.faces_of(edge).size();
        if (faces > 2) continue;
        const auto& [v, w] = mesh.edge(edge).vertices;
        const auto depth = [&](VertexId vertex) {
            return view.project_from_point(glm::dvec3(mesh.positions()[index(vertex)])).depth;
        };
        if (!view.is_orthographic() && std::min(depth(v), depth(w)) <= 1e-4 * mesh.radius())
            continue;
        const ExactView::Contour contour =
            faces == 1 ? ExactView::Contour::yes : exact.contour(edge);
        if (contour == ExactView::Contour::unknown) continue;
        CAPTURE(e);
        totals.silhouettes += contour == ExactView::Contour::yes ? 1 : 0;
        CHECK(std::abs(drawn[e] - (contour == ExactView::Contour::yes ? 1.0 : 0.0)) < 1e-5);
    }
}

void check_lines_of(const NamedSource& named, std::uint64_t seed, std::size_t most_pieces,
                    LineTotals& totals) {
    CAPTURE(named.name);
    const Mesh mesh(named.source);
    if (!(mesh.radius() > 0.0)) return;
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    Random random(seed);
    LineOptions options = checkable({});
    options.draws = {true, true, false, false};
    // From anywhere, along an axis, and from within.
    const glm::dvec3 anywhere = glm::dvec3(random.in_cube());
    glm::dvec3 axis(0.0);
    axis[static_cast<int>(seed % 3)] = seed % 2 == 0 ? 1.0 : -1.0;
    for (const glm::dvec3& way : {3.0 * anywhere, 3.0 * axis, 0.3 * anywhere})
        for (const bool is_orthographic : {false, true}) {
            const glm::dvec3 eye = mesh.center() + mesh.radius() * way;
            CAPTURE(eye.x);
            CAPTURE(eye.y);
            CAPTURE(eye.z);
            CAPTURE(is_orthographic);
            const LineView view = is_orthographic
                                      ? LineView::orthographic(eye, mesh.center(), {0, 1, 0})
                                      : LineView::perspective(eye, mesh.center(), {0, 1, 0});
            ++totals.views;
            check_drawing(mesh, view,
                          drawer.draw(view, brute_force_silhouette(mesh, view.point()), options),
                          most_pieces, totals);
        }
}

void check_lines_of_classes(std::uint32_t round, const Amount& amount, LineTotals& totals) {
    const std::vector<NamedSource> classes = hard_classes(round);
    REQUIRE(classes.size() > 100);
    for (std::size_t i = 0; i < classes.size(); i += amount.class_step)
        check_lines_of(classes[i], 1000 * round + i, amount.view_pieces, totals);
}

void report(const LineTotals& totals) {
    MESSAGE(totals.views, " views, ", totals.silhouettes, " silhouettes and borders, ",
            totals.pieces, " pieces of lines; of ", totals.checked_pieces, " that were checked, ",
            totals.hidden_pieces, " are hidden; ", totals.short_pieces,
            " are too short to be checked");
    CHECK(totals.silhouettes > 1000);
    CHECK(totals.hidden_pieces > totals.checked_pieces / 10);
    CHECK(totals.hidden_pieces < totals.checked_pieces * 99 / 100);
    CHECK(totals.short_pieces < totals.pieces / 10);
}

TEST_CASE("lines of hard meshes have the faces in front of them that exact arithmetic counts" *
          doctest::test_suite("plain")) {
    LineTotals totals;
    check_lines_of_classes(0, {3, 200}, totals);  // 3: each of the four states in turn.
    report(totals);
}

TEST_SUITE("long") {
    TEST_CASE(
        "lines of all hard meshes have the faces in front of them that exact arithmetic counts") {
        LineTotals totals;
        for (std::uint32_t round = 0; round < 3; ++round)
            check_lines_of_classes(round, {1, 600}, totals);
        report(totals);
    }
}

}  // namespace
}  // namespace rimline
