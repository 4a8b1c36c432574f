#include "silhouette/lines/line_strokes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stop_token>
#include <vector>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/against_oracle.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using Polyline = std::vector<glm::dvec2>;

// Each line is a visible run of a chain of its own.
LineDrawing joined(const std::vector<Polyline>& lines, const LineOptions& options = {.gap = 0.5}) {
    LineDrawing drawing;
    for (const Polyline& line : lines) {
        const auto run = static_cast<std::uint32_t>(drawing.runs.size());
        const auto first = static_cast<std::uint32_t>(drawing.points.size());
        double length = 0.0;
        for (std::size_t k = 0; k < line.size(); ++k) {
            if (k > 0) length += glm::distance(line[k - 1], line[k]);
            drawing.points.push_back({line[k], 1.0, length});
            drawing.sources.push_back({k_no_edge, 0.0f});
        }
        drawing.runs.push_back(
            {run, first, static_cast<std::uint32_t>(drawing.points.size()), 0, length});
        drawing.chains.push_back({run, run + 1, run, LineKind::silhouette, false, length});
    }
    LineStrokes().join(true, options, drawing);
    CHECK(drawing.sources.size() == drawing.points.size());
    return drawing;
}

// In the direction of the pen.
Polyline positions_of(const LineDrawing& drawing, const LineStroke& stroke) {
    Polyline positions;
    for (const StrokePart& part : drawing.parts_of(stroke)) {
        Polyline next;
        for (const LinePoint& point : drawing.points_of(part)) next.push_back(point.position);
        if (part.is_reversed) std::ranges::reverse(next);
        positions.insert(positions.end(), next.begin(), next.end());
    }
    return positions;
}

bool goes_forwards(const Polyline& positions) {
    return std::ranges::is_sorted(
        positions, [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
}

double distance_to(const Polyline& line, const glm::dvec2& p) {
    double least = glm::distance(p, line.front());
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 way = line[i + 1] - line[i];
        const double square = glm::dot(way, way);
        const double share =
            square > 0.0 ? std::clamp(glm::dot(p - line[i], way) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::distance(p, line[i] + share * way));
    }
    return least;
}

TEST_CASE("where one line begins beside the end of another, the stroke has each stretch once") {
    // The first ends on the second, so that the second is cut there.
    const Polyline first{{0, 0}, {6, 0.0}, {10, 0.1}}, second{{9, 0.2}, {11, 0.0}, {20, 0}};
    for (const bool is_first_reversed : {false, true})
        for (const bool is_second_reversed : {false, true}) {
            CAPTURE(is_first_reversed);
            CAPTURE(is_second_reversed);
            std::vector<Polyline> lines{first, second};
            if (is_first_reversed) std::ranges::reverse(lines[0]);
            if (is_second_reversed) std::ranges::reverse(lines[1]);
            const LineDrawing drawing = joined(lines);
            REQUIRE(drawing.strokes.size() == 1);
            const LineStroke& stroke = drawing.strokes[0];
            CHECK_FALSE(stroke.is_closed);
            Polyline positions = positions_of(drawing, stroke);
            if (positions.front().x > positions.back().x) std::ranges::reverse(positions);
            CHECK(goes_forwards(positions));
            CHECK(positions.front() == first.front());
            CHECK(positions.back() == second.back());
            CHECK(std::ranges::count(positions, second.front()) == 0);
            CHECK(stroke.length == doctest::Approx(20.0).epsilon(1e-3));
            // The runs are what they were.
            CHECK(drawing.points_of(drawing.runs[1]).size() == 3);
            CHECK(drawing.runs[1].length > 11.0);
        }
}

TEST_CASE("lines far beside or far along each other are strokes of their own") {
    const auto strokes = [](double overlap, double aside, double slope) {
        return joined({{{0, 0}, {20, 0}},
                       {{20 - overlap, aside}, {40, aside + slope * (20 + overlap)}}})
            .strokes.size();
    };
    CHECK(strokes(2.9, 0.1, 0.0) == 1);
    CHECK(strokes(3.1, 0.1, 0.0) == 2);
    CHECK(strokes(2.0, 0.24, 0.0) == 1);
    CHECK(strokes(2.0, 0.26, 0.0) == 2);
    // One of them begins farther away, and then meets the other.
    CHECK(strokes(2.0, -0.45, 0.2) == 1);
    CHECK(strokes(2.0, -0.55, 0.2) == 2);
    // Across each other.
    CHECK(strokes(0.2, -0.3, 1.5) == 2);
}

TEST_CASE("a short line over the ends of two others is a part of their stroke") {
    // As 282, 284 and 286 of the bunny.
    const LineDrawing drawing = joined({{{0, 0}, {8.59, 0.34}},
                                        {{8.562, 0.338}, {9.02, 0.354}},
                                        {{8.525, 0.335}, {10.01, 0.043}, {16, -0.2}}});
    REQUIRE(drawing.strokes.size() == 1);
    CHECK(drawing.parts_of(drawing.strokes[0]).size() == 3);
    CHECK(drawing.strokes[0].length == doctest::Approx(16.0).epsilon(0.01));
}

TEST_CASE("a stroke does not go back over itself where a line ends at the tip of another") {
    // The second comes to the end of the first, and turns back there.
    const LineDrawing drawing =
        joined({{{0, 0}, {10, 0}}, {{9.3, 0.4}, {10.0, 0.0}, {4, -0.2}, {2, -3}}});
    CHECK(drawing.strokes.size() == 2);
}

TEST_CASE("where a line is cut, its point lies on the edge of its segment") {
    LineDrawing drawing;
    const auto add = [&](const Polyline& line, double depth,
                         const std::vector<LineSource>& sources) {
        const auto run = static_cast<std::uint32_t>(drawing.runs.size());
        const auto first = static_cast<std::uint32_t>(drawing.points.size());
        for (const glm::dvec2& p : line) drawing.points.push_back({p, depth * (1.0 + p.x), p.x});
        drawing.sources.insert(drawing.sources.end(), sources.begin(), sources.end());
        drawing.runs.push_back({run, first, static_cast<std::uint32_t>(drawing.points.size()), 0,
                                line.back().x - line.front().x});
        drawing.chains.push_back({run, run + 1, run, LineKind::silhouette, false, 0.0});
    };
    // In perspective: depths 10 and 13 at x = 9 and 12, so that x = 10 is a third of the way in the picture.
    add({{0, 0}, {10, 0}}, 1.0, {{EdgeId{1}, 0.0f}, {EdgeId{1}, 1.0f}});
    add({{8, 0.2}, {9, 0.0}, {12, 0.0}, {20, 0}}, 1.0,
        {{EdgeId{2}, 0.0f}, {EdgeId{2}, 1.0f}, {EdgeId{3}, 0.0f}, {EdgeId{4}, 1.0f}});
    LineStrokes().join(false, {.gap = 0.5}, drawing);
    REQUIRE(drawing.strokes.size() == 1);
    const StrokePart part = drawing.parts_of(drawing.strokes[0])[1];
    REQUIRE(part.last_point - part.first_point == 3);
    const LinePoint& cut = drawing.points_of(part)[0];
    CHECK(cut.position.x == doctest::Approx(10.0));
    CHECK(1.0 / cut.depth == doctest::Approx((2.0 / 10.0 + 1.0 / 13.0) / 3.0));
    // The edge of the second segment, which begins at the edge's other end.
    CHECK(drawing.sources[part.first_point].edge == EdgeId{3});
    CHECK(drawing.sources[part.first_point].share ==
          doctest::Approx(1.0 - (1.0 / 3.0) * 10.0 / ((1.0 / 3.0) * 10.0 + (2.0 / 3.0) * 13.0)));
}

TEST_CASE("a loop whose ends overlap is closed, without its end twice") {
    Polyline loop;
    for (int i = 0; i <= 100; ++i) {
        const double angle = 6.5 * i / 100;
        loop.push_back(10.0 * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    const LineDrawing drawing = joined({loop});
    REQUIRE(drawing.strokes.size() == 1);
    CHECK(drawing.strokes[0].is_closed);
    CHECK(drawing.strokes[0].length == doctest::Approx(62.83).epsilon(1e-3));
    // Not if it is little more than what overlaps.
    CHECK_FALSE(joined({{{0, 0}, {2, 0}, {2, 0.2}, {0.1, 0.2}}}).strokes[0].is_closed);
}

TEST_CASE("the shortest length is that of the joined stroke") {
    const std::vector<Polyline> lines{
        {{0, 0}, {3, 0}}, {{2, 0.1}, {5, 0.1}}, {{4, 0}, {7, 0}}, {{20, 0}, {23, 0}}};
    const LineDrawing drawing = joined(lines, {.gap = 0.5, .min_length = 6.0});
    REQUIRE(drawing.strokes.size() == 1);
    CHECK(drawing.parts_of(drawing.strokes[0]).size() == 3);
    CHECK(drawing.strokes[0].length == doctest::Approx(7.0).epsilon(1e-3));
}

TEST_CASE("strokes are the same where x and y are exchanged") {
    tests::Random random(31);
    const auto at = [&] { return glm::dvec2(random.signed_unit(), random.signed_unit()); };
    for (const double gap : {0.0, 0.01, 0.1, 0.5}) {
        CAPTURE(gap);
        std::vector<Polyline> lines, turned;
        for (int i = 0; i < 400; ++i) {
            // Some on a grid, so that many ends have one x or one y.
            const glm::dvec2 from = i % 3 == 0 ? glm::floor(3.0 * at()) : 3.0 * at();
            const glm::dvec2 to = from + (i % 3 == 0 ? glm::dvec2(i % 2, 1 - i % 2) : 0.5 * at());
            lines.push_back({from, to});
            turned.push_back({{from.y, from.x}, {to.y, to.x}});
        }
        const LineDrawing one = joined(lines, {.gap = gap}), other = joined(turned, {.gap = gap});
        REQUIRE(one.strokes.size() == other.strokes.size());
        CHECK((gap == 0.0 || one.strokes.size() < 390));
        for (std::size_t i = 0; i < one.strokes.size(); ++i)
            CHECK(one.strokes[i].length == doctest::Approx(other.strokes[i].length));
    }
}

TEST_CASE("the time of joining grows as the number of lines does where all end on one line" *
          doctest::test_suite("plain")) {
    const auto seconds_of = [](int count, double gap) {
        std::vector<Polyline> slats;
        for (int i = 0; i < count; ++i) slats.push_back({{0, i}, {100, i}});
        double least = std::numeric_limits<double>::infinity();
        for (int repetition = 0; repetition < 5; ++repetition) {
            const std::clock_t begin = std::clock();  // Of this process alone.
            CHECK(joined(slats, {.gap = gap}).strokes.size() == slats.size());
            least = std::min(least, double(std::clock() - begin) / CLOCKS_PER_SEC);
        }
        return least;
    };
    for (const double gap : {0.0, 0.1}) {
        const double few = seconds_of(10'000, gap), many = seconds_of(80'000, gap);
        MESSAGE("10,000 lines: " << few << " s; 80,000: " << many << " s");
        CHECK(many < 30.0 * few);  // 64 times if the time were quadratic.
    }
}

TEST_CASE("joining can be cancelled") {
    LineDrawing drawing = joined({{{0, 0}, {1, 0}}, {{2, 0}, {3, 0}}});
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(LineStrokes().join(true, {.gap = 0.5}, drawing, stop.get_token()), Error);
}

TEST_CASE("contours of a smooth surface are few strokes, and nothing visible is far from them") {
    for (const char* shape : {"knot", "scene", "terrain"})
        for (const bool is_orthographic : {false, true}) {
            CAPTURE(shape);
            CAPTURE(is_orthographic);
            const Mesh mesh(make_built_in_shape(shape, 20'000));
            const LineSurface surface(mesh);
            LineDrawer drawer(surface);
            const LineView view = tests::view_of(mesh, {-1, 0.6, 3}, is_orthographic);
            const double gap = 0.003 * (is_orthographic ? mesh.radius() : 0.35);
            const LineDrawing& drawing =
                drawer.draw(view, brute_force_silhouette(mesh, view.point()), {.gap = gap});
            std::vector<Polyline> strokes;
            for (const LineStroke& stroke : drawing.strokes)
                strokes.push_back(positions_of(drawing, stroke));
            std::size_t runs = 0;
            for (const LineRun& run : drawing.runs) {
                if (!run.is_visible()) continue;
                ++runs;
                double farthest = 0.0;
                for (const LinePoint& point : drawing.points_of(run)) {
                    double least = std::numeric_limits<double>::infinity();
                    for (const Polyline& stroke : strokes)
                        least = std::min(least, distance_to(stroke, point.position));
                    farthest = std::max(farthest, least);
                }
                // Of a line beside others, a part lies beside what is left of those alone.
                CHECK(farthest <= 2.0 * gap);
            }
            CHECK(strokes.size() < 0.6 * double(runs));
        }
}

}  // namespace
}  // namespace rimline
