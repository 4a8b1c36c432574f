#include "silhouette/lines/line_drawer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/against_oracle.h"
#include "tests/silhouette/lines/difficult_meshes.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/stops.h"

namespace rimline {
namespace {

using tests::Cameras;

LineDrawing draw(const Mesh& mesh, const LineView& view, const LineOptions& options = {}) {
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    return drawer.draw(view, brute_force_silhouette(mesh, view.point()), options);
}

double length_of(const LineDrawing& drawing, bool is_visible) {
    double length = 0.0;
    for (const LineRun& run : drawing.runs)
        if (run.is_visible() == is_visible) length += run.length;
    return length;
}

// Corners on a grid of small integers, so that faces touch and coincide in every way.
MeshSource grid_soup(std::uint64_t seed) {
    tests::Random random(seed);
    MeshSource source;
    const int size = 3 + static_cast<int>(random.below(6));
    const std::uint32_t faces = 10 + random.below(60);
    for (std::uint32_t f = 0; f < faces; ++f) {
        const glm::vec3 at(random.between(0, size), random.between(0, size),
                           random.between(0, size));
        for (int k = 0; k < 3; ++k)
            source.positions.push_back(at + glm::vec3(random.between(-2, 2), random.between(-2, 2),
                                                      random.between(-2, 2)));
        source.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    return source;
}

void add_box(MeshSource& source, const glm::vec3& low, const glm::vec3& high) {
    constexpr std::uint32_t k_sides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                             {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    const auto first = static_cast<std::uint32_t>(source.positions.size());
    for (int corner = 0; corner < 8; ++corner)
        source.positions.push_back({corner & 4 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                    corner & 1 ? high.z : low.z});
    for (const auto& [a, b, c, d] : k_sides) {
        source.triangles.push_back({first + a, first + b, first + c});
        source.triangles.push_back({first + a, first + c, first + d});
    }
}

// Boxes on a grid that touch and overlap.
MeshSource grid_boxes(std::uint64_t seed) {
    tests::Random random(seed);
    MeshSource source;
    for (int box = 0; box < 12; ++box) {
        const glm::vec3 low(random.between(0, 5), random.between(0, 5), random.between(0, 5));
        const glm::vec3 size(random.between(1, 3), random.between(1, 3), random.between(1, 3));
        add_box(source, low, low + size);
    }
    return source;
}

// Two boxes, of which the second was turned by 90 degrees, so that its edges cross those of the first at angles of
// 10^-16.
MeshSource turned_box(double height) {
    MeshSource source;
    add_box(source, {-1, -1, 0}, {1, 0, 1});
    add_box(source, {0.0, -1.5, 0.0}, {1.0, 0.5, height});
    const double c = std::cos(std::numbers::pi / 2), s = std::sin(std::numbers::pi / 2);
    for (std::size_t v = 8; v < 16; ++v) {
        const glm::dvec3 p(source.positions[v]);
        source.positions[v] = {p.x * c - p.y * s, p.x * s + p.y * c, p.z};
    }
    return source;
}

// Two ridges that cross with a slope of the second one.
MeshSource ridges(float slope) {
    return {{{-1, 0, 0},
             {1, 0, 0},
             {0, -1, 1},
             {0.1f, -1, -1},
             {-0.5f, -0.5f * slope, 0},
             {1, slope, 0},
             {0, 1, 1},
             {0.1f, 1, -1}},
            {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}, {5, 4, 7}}};
}

TEST_CASE("edges that cross at next to no angle cross where they do") {
    for (const double height : {0.5, 0.7, 1.0, 1.3}) {
        CAPTURE(height);
        const Mesh mesh(turned_box(height));
        tests::check_views(mesh, Cameras::around, 4, 3);
        tests::check_views(mesh, Cameras::axes, 3, 5);
    }
    for (const float slope : {1e-3f, 1e-6f, 1e-9f, 3e-11f, 1e-16f, 1e-20f, 1e-30f}) {
        CAPTURE(slope);
        const Mesh mesh(ridges(slope));
        const LineDrawing drawing =
            draw(mesh, LineView::orthographic({1, 2, 3}, glm::dvec3(0.0), {0, 1, 0}));
        std::size_t crossings = 0;
        for (const LineRun& run : drawing.runs)
            for (const LinePoint& point : drawing.points_of(run)) {
                CHECK(std::isfinite(point.position.x + point.position.y));
                crossings += glm::length(point.position) < 1e-9;
            }
        CHECK(crossings > 0);
    }
}

TEST_CASE("lines of built-in shapes are hidden where a count of faces says" *
          doctest::test_suite("plain")) {
    for (const char* shape : {"sphere", "torus", "knot", "box", "spring", "terrain", "scene"}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, shape == std::string("box") ? 12 : 3000));
        tests::check_views(mesh, Cameras::around, 2, 11);
        tests::check_views(mesh, Cameras::axes, 3, 12);
        tests::check_views(mesh, Cameras::inside, 1, 13, 100.0);
    }
}

TEST_CASE("lines of soups on a grid are hidden where a count of faces says" *
          doctest::test_suite("plain")) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Mesh mesh(grid_soup(seed));
        tests::check_views(mesh, Cameras::around, 1, seed, 100.0);
        tests::check_views(mesh, Cameras::axes, 1, seed, 100.0);
        tests::check_views(mesh, Cameras::inside, 1, seed, 100.0);
    }
}

TEST_CASE("lines of boxes that touch and overlap are hidden where a count of faces says") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Mesh mesh(grid_boxes(seed));
        tests::check_views(mesh, Cameras::around, 2, seed, 200.0);
        tests::check_views(mesh, Cameras::axes, 3, seed, 200.0);
    }
}

TEST_CASE("lines of a broken mesh are hidden where a count of faces says") {
    const Mesh mesh(tests::broken_knot(4));
    CHECK(mesh.edges_of_class(EdgeClass::border).size() > 100);
    CHECK(mesh.edges_of_class(EdgeClass::nonmanifold).size() > 100);
    CHECK(mesh.edges_of_class(EdgeClass::inconsistent).size() > 100);
    tests::check_views(mesh, Cameras::around, 3, 14);
}

TEST_SUITE("long") {
    TEST_CASE("lines of two thousand soups are hidden where a count of faces says") {
        for (std::uint64_t seed = 1000; seed < 3000; ++seed)
            tests::check_views(Mesh(grid_soup(seed)),
                               seed % 2 == 0 ? Cameras::axes : Cameras::around, 1, seed, 100.0);
    }
}

TEST_CASE("a sphere is one visible loop") {
    const Mesh mesh(make_built_in_shape("sphere", 5000));
    LineOptions options;
    options.draws = {true, true, false, true};
    for (const bool is_orthographic : {false, true}) {
        const LineDrawing drawing =
            draw(mesh, tests::view_of(mesh, {1, 2, 3}, is_orthographic), options);
        REQUIRE(drawing.chains.size() == 1);
        CHECK(drawing.chains[0].is_closed);
        REQUIRE(drawing.runs.size() == 1);
        CHECK(drawing.runs[0].is_visible());
        REQUIRE(drawing.strokes.size() == 1);
        CHECK(drawing.strokes[0].is_closed);
    }
}

TEST_CASE("a box from the front has four visible edges and no hidden line") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const LineView view = tests::view_of(mesh, {0, 0, 1}, true);
    const LineDrawing drawing = draw(mesh, view);
    CHECK(length_of(drawing, false) == 0.0);
    const Bounds& bounds = mesh.bounds();
    const double outline =
        2.0 * (double{bounds.high.x} - bounds.low.x) + 2.0 * (double{bounds.high.y} - bounds.low.y);
    CHECK(length_of(drawing, true) == doctest::Approx(outline).epsilon(1e-6));

    LineOptions all;
    all.keeps_coincident = true;
    CHECK(length_of(draw(mesh, view, all), false) > 0.4 * outline);
}

// Seen from the point beside the eye, the edges of the back lie a little beside those of the front.
TEST_CASE("lines that coincide are drawn once wherever they lie in the picture") {
    constexpr std::uint64_t k_seed = 31;
    CAPTURE(k_seed);
    tests::Random random(k_seed);
    for (int i = 0; i < 1000; ++i) {
        CAPTURE(i);
        MeshSource source = make_built_in_shape("box", 12);
        const glm::vec3 size = 1.0f + 0.5f * random.in_cube();
        const glm::vec3 place = random.in_cube();
        for (glm::vec3& p : source.positions) p = size * p + place;
        // Far away, something that makes the picture large.
        const auto first = static_cast<std::uint32_t>(source.positions.size());
        for (const glm::vec3& p : {glm::vec3(4, 4, 0), glm::vec3(4, 5, 0), glm::vec3(5, 4, 0)})
            source.positions.push_back(p + 0.3f * place);
        source.triangles.push_back({first, first + 1, first + 2});
        const Mesh mesh(source);
        const LineDrawing drawing = draw(mesh, tests::view_of(mesh, {0, 0, 1}, true));
        CHECK(length_of(drawing, false) == 0.0);
        const double outline = 4.0 * double{size.x} + 4.0 * double{size.y} + 2.0 + std::sqrt(2.0);
        CHECK(length_of(drawing, true) == doctest::Approx(outline).epsilon(1e-5));
    }
}

TEST_CASE("a mesh without faces has no lines") {
    const Mesh mesh(MeshSource{});
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    const LineView view = LineView::perspective({0, 0, 3}, {0, 0, 0}, {0, 1, 0});
    CHECK(drawer.draw(view, {}).chains.empty());
}

// Seen edge-on, a face's plane and its corners differ about its side. Its edges are creases all the same.
TEST_CASE("a crease between faces of opposite directions is drawn where one is seen edge-on") {
    const Mesh mesh({{{3, 4, -1},
                      {2, 3, 0},
                      {1, 3, 0},
                      {0, 4, 4},
                      {-1, 3, 2},
                      {1, 3, 3},
                      {2, 2, 1},
                      {3, 3, 2},
                      {1, 4, 1},
                      {-1, 3, 0},
                      {1, 4, 0},
                      {-1, 4, 1}},
                     {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {7, 8, 9}}});
    const LineDrawing drawing = draw(mesh, tests::view_of(mesh, {0, -1, 0}, true), checkable({}));
    bool is_drawn = false;
    for (const LineSource& source : drawing.sources)
        is_drawn |= mesh.edge_class(source.edge) == EdgeClass::inconsistent;
    REQUIRE(mesh.edges_of_class(EdgeClass::inconsistent).size() == 1);
    CHECK(is_drawn);
}

// Scaled by a power of two, or with all faces reversed, nothing changes.
TEST_CASE("visibility does not depend on scale and orientation") {
    const MeshSource source = tests::broken_knot(5);
    const auto counts_of = [](const MeshSource& s, double scale) {
        const Mesh mesh(s);
        const LineView view =
            LineView::perspective(scale * glm::dvec3(2, 3, 4), glm::dvec3(0.0), {0, 1, 0});
        std::vector<std::uint32_t> counts;
        const LineDrawing drawing = draw(mesh, view, checkable({}));
        for (const LineRun& run : drawing.runs) counts.push_back(run.hidden_by);
        std::sort(counts.begin(), counts.end());
        return counts;
    };
    const std::vector<std::uint32_t> counts = counts_of(source, 1.0);
    CHECK(counts.size() > 500);
    MeshSource scaled = source;
    for (glm::vec3& p : scaled.positions) p *= 0x1p10f;
    CHECK(counts_of(scaled, 0x1p10) == counts);
    MeshSource reversed = source;
    for (auto& t : reversed.triangles) std::swap(t[1], t[2]);
    CHECK(counts_of(reversed, 1.0) == counts);
}

TEST_CASE("gaps are bridged up to their length and short strokes are left out") {
    const Mesh mesh(make_built_in_shape("scene", 20'000));
    const LineView view = tests::view_of(mesh, {1, 1, 2}, false);
    LineOptions options;
    const LineDrawing exact = draw(mesh, view, options);
    options.gap = 0.002;
    const LineDrawing bridged = draw(mesh, view, options);
    CHECK(bridged.strokes.size() < exact.strokes.size());
    // Nothing visible becomes hidden, however short: it may be the outline.
    REQUIRE(bridged.chains.size() == exact.chains.size());
    double added = 0.0;
    for (std::size_t c = 0; c < exact.chains.size(); ++c) {
        const auto visible_length = [&](const LineDrawing& drawing) {
            double length = 0.0;
            for (const LineRun& run : drawing.runs_of(drawing.chains[c]))
                if (run.is_visible()) length += run.length;
            return length;
        };
        const double more = visible_length(bridged) - visible_length(exact);
        CHECK(more >= -1e-9);
        added += more;
    }
    CHECK(added > 0.0);
    options.min_length = 0.01;
    const LineDrawing longer = draw(mesh, view, options);
    CHECK(longer.strokes.size() < bridged.strokes.size());
    for (const LineStroke& stroke : longer.strokes) CHECK(stroke.length >= 0.01);
    for (const LineChain& chain : exact.chains) {
        double length = 0.0;
        for (const LineRun& run : exact.runs_of(chain)) length += run.length;
        CHECK(length <= chain.length * (1.0 + 1e-9));
    }
}

TEST_CASE("visible lines are the same whether counts are split or not") {
    for (const char* shape : {"scene", "knot"}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, 20'000));
        const LineView view = tests::view_of(mesh, {1, 1, 2}, false);
        LineOptions options{.gap = 0.004};
        const LineDrawing joined = draw(mesh, view, options);
        options.splits_counts = true;
        const LineDrawing split = draw(mesh, view, options);
        CHECK(split.runs.size() > joined.runs.size());
        REQUIRE(split.strokes.size() == joined.strokes.size());
        for (std::size_t i = 0; i < split.strokes.size(); ++i)
            CHECK(split.strokes[i].length ==
                  doctest::Approx(joined.strokes[i].length).epsilon(1e-9));
    }
}

TEST_CASE(
    "an outline with right angles is one closed stroke where its lines coincide with others") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const LineView view = tests::view_of(mesh, {0, 0, 1}, true);
    const LineDrawing drawing = draw(mesh, view, {.gap = 0.01});
    REQUIRE(drawing.strokes.size() == 1);
    CHECK(drawing.strokes[0].is_closed);
    CHECK(drawing.strokes[0].length == doctest::Approx(8.0));
    // The outline, and three creases of one corner: two go on in one direction as well as any, the third ends there.
    const LineView slanted = tests::view_of(mesh, {1, 1, 1}, true);
    CHECK(draw(mesh, slanted, {.gap = 0.01}).strokes.size() == 3);
}

TEST_CASE("a drawing can be cancelled") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    const LineView view = tests::view_of(mesh, {1, 2, 3}, false);
    const std::vector<EdgeId> silhouette = brute_force_silhouette(mesh, view.point());
    for (int calls = 0; calls < 5; ++calls) {
        std::stop_source stop;
        int count = 0;
        const LongCall call{stop.get_token(), [&](double) {
                                if (count++ == calls) stop.request_stop();
                            }};
        CHECK_THROWS_AS(drawer.draw(view, silhouette, {}, call), Error);
    }
    CHECK(!drawer.draw(view, silhouette).chains.empty());
}

TEST_CASE("edges that the mesh does not have and lengths below 0 or without end stop the program") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    const LineView view = tests::view_of(mesh, {1, 2, 3}, false);
    const std::vector<EdgeId> silhouette = brute_force_silhouette(mesh, view.point());
    const std::vector<EdgeId> wrong{EdgeId{mesh.edge_count()}};
    CHECK(tests::stops([&] { drawer.draw(view, wrong); }));
    const std::vector<std::uint8_t> all(mesh.edge_count(), 1), too_few(mesh.edge_count() - 1, 1);
    LineOptions options;
    options.shown_creases = all;
    CHECK_FALSE(tests::stops([&] { drawer.draw(view, silhouette, options); }));
    options.shown_creases = too_few;
    CHECK(tests::stops([&] { drawer.draw(view, silhouette, options); }));
    CHECK(tests::stops([&] { drawer.draw(view, silhouette, {.gap = -1.0}); }));
    CHECK(tests::stops([&] { drawer.draw(view, silhouette, {.simplify = std::nan("")}); }));
    constexpr double k_endless = std::numeric_limits<double>::infinity();
    CHECK(tests::stops([&] { drawer.draw(view, silhouette, {.gap = k_endless, .stubble = 1.0}); }));
}

}  // namespace
}  // namespace rimline
