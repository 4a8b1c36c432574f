#include "silhouette/lines/line_stubble.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <set>
#include <vector>

#include "silhouette/lines/face_count.h"
#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_geometry.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/against_oracle.h"
#include "tests/silhouette/lines/difficult_meshes.h"

namespace rimline {
namespace {

// Doubles are shorter than this many times the stubble.
constexpr double k_longest_double = 6.0;

struct StrokePlace {
    glm::dvec2 position, way;  // The way has length 1.
};

// A stroke as a polyline.
class DrawnStroke {
public:
    DrawnStroke(const LineDrawing& drawing, const LineStroke& stroke)
        : length(stroke.length), is_closed(stroke.is_closed) {
        for (const StrokePart& part : drawing.parts_of(stroke)) {
            const std::span<const LinePoint> points = drawing.points_of(part);
            parts_.emplace_back();
            for (const LinePoint& point : points) parts_.back().push_back(point.position);
            if (part.is_reversed) std::ranges::reverse(parts_.back());
        }
    }

    double distance_to(const glm::dvec2& p) const {
        double least = glm::distance(p, parts_.front().front());
        each_segment([&](const glm::dvec2& from, const glm::dvec2& to) {
            const glm::dvec2 way = to - from;
            const double square = glm::dot(way, way);
            const double share =
                square > 0.0 ? std::clamp(glm::dot(p - from, way) / square, 0.0, 1.0) : 0.0;
            least = std::min(least, glm::distance(p, from + share * way));
        });
        return least;
    }
    std::array<glm::dvec2, 2> ends() const {
        return {parts_.front().front(), parts_.back().back()};
    }
    /// The greatest distance of two of its points.
    double diameter() const {
        double greatest = 0.0;
        for (const std::vector<glm::dvec2>& part : parts_)
            for (const glm::dvec2& p : part)
                for (const std::vector<glm::dvec2>& other : parts_)
                    for (const glm::dvec2& q : other)
                        greatest = std::max(greatest, glm::distance(p, q));
        return greatest;
    }
    /// Places in the middle of stretches of about this length, in the order of the stroke.
    std::vector<StrokePlace> places(double spacing) const {
        std::vector<StrokePlace> places;
        const double step = length / std::ceil(length / spacing);
        double next = 0.5 * step, arc = 0.0;
        each_segment([&](const glm::dvec2& from, const glm::dvec2& to) {
            const double part = glm::distance(from, to);
            for (; next < arc + part; next += step)
                places.push_back({glm::mix(from, to, (next - arc) / part), (to - from) / part});
            arc += part;
        });
        return places;
    }

    double length;
    bool is_closed;

private:
    template <typename Visit>
    void each_segment(Visit&& visit) const {
        for (const std::vector<glm::dvec2>& part : parts_)
            for (std::size_t i = 0; i + 1 < part.size(); ++i) visit(part[i], part[i + 1]);
    }
    std::vector<std::vector<glm::dvec2>> parts_;
};

// A drawing without stubble, and which of its strokes a drawing with stubble keeps.
struct StubblePair {
    LineDrawing all;
    std::vector<DrawnStroke> strokes,
        left;  // Without stubble: those that are kept, without their tails.
    std::vector<std::uint8_t> is_kept;
    std::size_t kept = 0;

    StubblePair(LineDrawer& drawer, const Mesh& mesh, const LineView& view, LineOptions options) {
        const std::vector<EdgeId> silhouette = brute_force_silhouette(mesh, view.point());
        const double stubble = options.stubble;
        options.stubble = 0.0;
        all = drawer.draw(view, silhouette, options);
        options.stubble = stubble;
        const LineDrawing& less = drawer.draw(view, silhouette, options);
        REQUIRE(less.points.size() >= all.points.size());
        REQUIRE(less.runs.size() == all.runs.size());
        REQUIRE(less.chains.size() == all.chains.size());
        std::set<std::uint32_t> kept_runs;
        for (const LineStroke& stroke : less.strokes) {
            left.emplace_back(less, stroke);
            for (const StrokePart& part : less.parts_of(stroke)) kept_runs.insert(part.run);
        }
        for (const LineStroke& stroke : all.strokes) {
            strokes.emplace_back(all, stroke);
            is_kept.push_back(std::ranges::any_of(
                all.parts_of(stroke),
                [&](const StrokePart& part) { return kept_runs.contains(part.run); }));
            kept += is_kept.back();
        }
        REQUIRE(kept == less.strokes.size());
    }
    // Whether another stroke passes within `reach`.
    template <typename IsAsked>
    bool passes_near(const glm::dvec2& place, double reach, IsAsked&& is_asked) const {
        for (std::size_t s = 0; s < strokes.size(); ++s)
            if (is_asked(s) && strokes[s].distance_to(place) <= reach) return true;
        return false;
    }
};

LineOptions stubble_of(double size) {
    LineOptions options;
    options.gap = 0.006 * size;
    options.stubble = 0.03 * size;
    return options;
}

template <typename Visit>
void each_stubbly_view(Visit&& visit) {
    const std::array<MeshSource, 4> sources{
        make_built_in_shape("scene", 5000), make_built_in_shape("knot", 3000),
        make_built_in_shape("terrain", 5000), tests::rough_sphere(3000, 0.02f, 5)};
    for (std::size_t shape = 0; shape < sources.size(); ++shape) {
        CAPTURE(shape);
        const Mesh mesh(sources[shape]);
        const LineSurface surface(mesh);
        LineDrawer drawer(surface);
        for (const bool is_orthographic : {false, true})
            for (const glm::dvec3& direction : {glm::dvec3(1, 2, 3), glm::dvec3(-3, 1, 0.5)}) {
                CAPTURE(is_orthographic);
                CAPTURE(direction.x);
                const LineView view = tests::view_of(mesh, direction, is_orthographic);
                const LineOptions options = stubble_of(is_orthographic ? mesh.radius() : 0.35);
                visit(surface, view, options, StubblePair(drawer, mesh, view, options));
            }
    }
}

TEST_CASE("only short strokes with loose ends and doubles and tails of doubles are stubble") {
    std::size_t loose = 0, doubles = 0, kept = 0;
    each_stubbly_view([&](const LineSurface&, const LineView&, const LineOptions& options,
                          const StubblePair& pair) {
        kept += pair.kept;
        for (std::size_t s = 0; s < pair.strokes.size(); ++s) {
            if (pair.is_kept[s] != 0) continue;
            const DrawnStroke& stroke = pair.strokes[s];
            CAPTURE(stroke.length);
            CHECK(stroke.length < k_longest_double * options.stubble);
            // An end is not loose where a stroke is that stays.
            int loose_ends = stroke.is_closed ? 1 : 0;
            if (!stroke.is_closed)
                for (const glm::dvec2& end : stroke.ends())
                    loose_ends +=
                        !pair.passes_near(end, options.gap * (1.0 - 1e-9),
                                          [&](std::size_t i) { return pair.is_kept[i] != 0; });
            // What is narrow looks like one line.
            const bool is_narrow = stroke.is_closed && stroke.length <= 2.15 * stroke.diameter();
            if (stroke.length < (is_narrow ? 2 : loose_ends) * options.stubble) {
                ++loose;
                continue;
            }
            ++doubles;
            // Beside others, but for a tail at each end.
            double bare = 0.0;
            for (const StrokePlace& place : stroke.places(0.5 * options.gap))
                if (!pair.passes_near(place.position, options.gap * 1.5, [&](std::size_t i) {
                        return i != s &&
                               (pair.is_kept[i] != 0 || pair.strokes[i].length >= stroke.length);
                    }))
                    bare += 0.5 * options.gap;
            CHECK(bare < 2.0 * options.stubble);
        }
    });
    CHECK(kept > 100);
    CHECK(loose > 50);
    CHECK(doubles > 5);
}

// The silhouette of a surface against the background.
bool is_at_background(const LineSurface& surface, const LineView& view, const StrokePlace& place,
                      double reach) {
    const glm::dvec2 side = reach * glm::dvec2(-place.way.y, place.way.x);
    const double depth = glm::length(surface.mesh().center()) + 10.0 * surface.mesh().radius();
    for (const double sign : {1.0, -1.0}) {
        const glm::dvec3 far = view.unproject({place.position + sign * side, depth});
        if (count_before_point(surface.geometry(), view, far, [](std::uint32_t) {
                return false;
            }).count == 0)
            return true;
    }
    return false;
}

// At a place of the outline there is nothing behind the line on one side. The test for it looks at places a quarter of
// the stubble apart.
TEST_CASE("outlines have no gaps where stubble was" * doctest::test_suite("plain")) {
    std::size_t of_removed = 0;
    each_stubbly_view([&](const LineSurface& surface, const LineView& view,
                          const LineOptions& options, const StubblePair& pair) {
        const double spacing = options.stubble / 32.0;
        for (std::size_t s = 0; s < pair.strokes.size(); ++s) {
            double bare = 0.0;
            for (const StrokePlace& place : pair.strokes[s].places(spacing)) {
                const bool is_outline = is_at_background(surface, view, place, 0.5 * options.gap);
                of_removed += is_outline && pair.is_kept[s] == 0;
                const bool is_bare =
                    is_outline && std::ranges::none_of(pair.left, [&](const DrawnStroke& stroke) {
                        return stroke.distance_to(place.position) <= options.gap;
                    });
                bare = is_bare ? bare + spacing : 0.0;
                CHECK(bare <= 0.25 * options.stubble);
            }
        }
    });
    CHECK(of_removed > 300);
}

TEST_CASE("a stubble of nearly zero leaves all strokes") {
    std::size_t removed = 0;
    each_stubbly_view([&](const LineSurface& surface, const LineView& view, LineOptions options,
                          const StubblePair& pair) {
        options.stubble = 1e-9 * options.gap;
        LineDrawer drawer(surface);
        const StubblePair none(drawer, surface.mesh(), view, options);
        CHECK(none.kept == none.strokes.size());
        removed += none.kept - pair.kept;
    });
    CHECK(removed > 100);
}

// A polyline is closed if it ends where it begins.
using Polyline = std::vector<glm::dvec2>;

// Strokes before a square from (-10, -10) to (10, 10).
class StrokesBeforeSquare {
public:
    StrokesBeforeSquare()
        : mesh_({{{-10, -10, -1}, {10, -10, -1}, {10, 10, -1}, {-10, 10, -1}},
                 {{0, 1, 2}, {0, 2, 3}}}),
          surface_(mesh_),
          view_(LineView::orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0})) {}

    // How many of these lines stay, whether the first one does, and where it begins and ends then.
    struct Kept {
        std::size_t count;
        bool is_first_kept;
        glm::dvec2 from, to;
    };
    // By default they lie on the diagonal of the square, which does not bend.
    Kept keep(const std::vector<Polyline>& lines, EdgeId edge = EdgeId{0}, double gap = 0.1) const {
        LineDrawing drawing;
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            const auto first = static_cast<std::uint32_t>(drawing.points.size());
            double length = 0.0;
            for (std::size_t k = 0; k < lines[i].size(); ++k) {
                if (k > 0) length += glm::distance(lines[i][k - 1], lines[i][k]);
                drawing.points.push_back({lines[i][k], 0.0, length});
            }
            const auto last = static_cast<std::uint32_t>(drawing.points.size());
            drawing.sources.resize(last, {edge, 0.0f});
            drawing.runs.push_back({i, first, last, 0, length});
            drawing.stroke_parts.push_back(drawing.whole(i, false));
            drawing.strokes.push_back({i, i + 1, lines[i].front() == lines[i].back(), length});
        }
        LineFrame frame;
        frame.surface = &surface_.geometry();
        frame.view = &view_;
        LineOptions options;
        options.stubble = 1.0;
        options.gap = gap;
        LineStubble().remove(frame, options, drawing);
        if (drawing.strokes.empty() || drawing.parts_of(drawing.strokes[0])[0].run != 0)
            return {drawing.strokes.size(), false, {}, {}};
        const auto points = drawing.points_of(drawing.parts_of(drawing.strokes[0])[0]);
        CHECK(drawing.strokes[0].length == doctest::Approx(points.back().arc - points.front().arc));
        CHECK(drawing.sources.size() == drawing.points.size());
        return {drawing.strokes.size(), true, points.front().position, points.back().position};
    }

private:
    Mesh mesh_;
    LineSurface surface_;
    LineView view_;
};

Polyline horizontal(double from, double to, double y) { return {{from, y}, {to, y}}; }
Polyline vertical(double x, double from, double to) { return {{x, from}, {x, to}}; }

TEST_CASE("a stroke with two loose ends goes if it is shorter than twice the stubble") {
    const StrokesBeforeSquare strokes;
    CHECK(strokes.keep({horizontal(0, 1.99, 0)}).count == 0);
    CHECK(strokes.keep({horizontal(0, 2.01, 0)}).count == 1);
    // With one loose end.
    CHECK(strokes.keep({horizontal(0.05, 0.99, 0), vertical(0, -5, 5)}).count == 1);
    CHECK(strokes.keep({horizontal(0.05, 1.06, 0), vertical(0, -5, 5)}).count == 2);
    CHECK(strokes.keep({horizontal(0.11, 1.9, 0), vertical(0, -5, 5)}).count == 1);
}

TEST_CASE("short strokes that hold only each other go as one closed stroke of their length does") {
    const StrokesBeforeSquare strokes;
    // Two sides of a sliver, 0.3 wide, that touch at both ends.
    const auto sliver = [](double length) {
        return std::vector<Polyline>{{{0, 0}, {0.5 * length, 0.15}, {length, 0}},
                                     {{0, 0}, {0.5 * length, -0.15}, {length, 0}}};
    };
    CHECK(strokes.keep(sliver(0.3)).count == 0);
    CHECK(strokes.keep(sliver(0.6)).count == 2);
    // A longer stroke holds them.
    std::vector<Polyline> held = sliver(0.3);
    held.push_back(horizontal(0.3, 5, 0));
    CHECK(strokes.keep(held).count == 3);
}

TEST_CASE("what closes and is narrow counts as a line of half its length, at every angle") {
    const StrokesBeforeSquare strokes;
    for (int degrees = 0; degrees < 180; degrees += 5) {
        CAPTURE(degrees);
        const double angle = glm::radians(double(degrees));
        const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
        // A rhombus as one closed stroke, and as two that touch at both ends.
        const auto kept = [&](double length, double width) {
            const std::array<glm::dvec2, 4> corners{
                glm::dvec2(0.0), 0.5 * (length * along + width * across), length * along,
                0.5 * (length * along - width * across)};
            const std::size_t closed =
                strokes.keep({{corners[0], corners[1], corners[2], corners[3], corners[0]}}).count;
            const std::size_t halves = strokes
                                           .keep({{corners[0], corners[1], corners[2]},
                                                  {corners[0], corners[3], corners[2]}})
                                           .count;
            CHECK(halves == 2 * closed);
            return closed;
        };
        CHECK(kept(0.9, 0.15) == 0);
        CHECK(kept(0.9, 0.4) == 1);
    }
    CHECK(strokes.keep({{{0, 0}, {1.01, 0.05}, {0, 0}}}).count == 1);
    // Held by a long stroke, two sides of a sliver stay.
    CHECK(strokes
              .keep({{{0, 0}, {0.4, 0.06}, {0.8, 0}},
                     {{0, 0}, {0.4, -0.06}, {0.8, 0}},
                     horizontal(0.8, 5, 0)})
              .count == 3);
}

TEST_CASE("a short stroke between two long ones stays") {
    const StrokesBeforeSquare strokes;
    CHECK(
        strokes.keep({horizontal(0.05, 0.45, 0), vertical(0, -5, 5), vertical(0.5, -5, 5)}).count ==
        3);
    CHECK(
        strokes.keep({horizontal(0.05, 0.35, 0), vertical(0, -5, 5), vertical(0.5, -5, 5)}).count ==
        2);
}

TEST_CASE("a loose stroke that two longer ones end at stays") {
    const StrokesBeforeSquare strokes;
    CHECK(strokes.keep({vertical(0, -0.5, 0.5), horizontal(-5, -0.05, 0), horizontal(0.05, 5, 0.2)})
              .count == 3);
    CHECK(!strokes.keep({vertical(0, -0.5, 0.5), horizontal(-5, -0.05, 0)}).is_first_kept);
    // The longer ones hold each other.
    CHECK(!strokes.keep({vertical(0, -0.5, 0.5), horizontal(-5, -0.04, 0), horizontal(0.04, 5, 0)})
               .is_first_kept);
}

TEST_CASE("a double beside a longer stroke goes") {
    const StrokesBeforeSquare strokes;
    const auto longer = horizontal(-8, 8, 0);
    CHECK(!strokes.keep({horizontal(0, 5.9, 0.09), longer}).is_first_kept);
    CHECK(strokes.keep({horizontal(0, 6.1, 0.09), longer}).is_first_kept);
    CHECK(strokes.keep({horizontal(0, 5.9, 0.11), longer}).is_first_kept);
    // One across the other is short, and no double: here at a corner, to the next stroke.
    const auto from_corner = horizontal(0.01, 0.09, 0);
    CHECK(
        strokes.keep({from_corner, vertical(0, -5, 0.02), horizontal(0.1, 5, 0.01)}).is_first_kept);
    // A part of it is not beside the other, or only goes on from its end.
    CHECK(strokes.keep({{glm::dvec2(0, 0.05), glm::dvec2(5, 0.15)}, longer}).is_first_kept);
    CHECK(strokes.keep({horizontal(3, 8.05, 0.05), longer}).is_first_kept);
    CHECK(strokes.keep({horizontal(-8.05, -3, 0.05), longer}).is_first_kept);
    // Of two equal ones the first stays, and so does one that is beside what goes.
    CHECK(strokes.keep({horizontal(0, 5, 0), horizontal(0, 5, 0.05)}).count == 1);
    CHECK(strokes.keep({horizontal(0, 5, 0.16), horizontal(0, 5.5, 0.08), longer}).is_first_kept);
}

// The first bridges a gap between two longer strokes at the outline. There a loop lies that holds neither, and the last
// segments of the longer ones are short.
TEST_CASE("a stroke stays where others lie before and behind a part of it, not beside") {
    const StrokesBeforeSquare strokes;
    const auto bridge = [&](double from, double to) {
        const Polyline left{{-8, 10}, {from - 0.01, 10}, {from, 10}};
        const Polyline right{{to, 10}, {to + 0.01, 10}, {9, 10}};
        const Polyline loop{{0.47, 10}, {0.53, 10}, {0.5, 9.99}, {0.47, 10}};
        return strokes.keep({horizontal(0, 1, 9.98), left, right, loop});
    };
    CHECK(bridge(0.38, 0.62).is_first_kept);
    CHECK(!bridge(0.49, 0.51).is_first_kept);
    // A dot has nothing before and behind it.
    const auto between = [&](double from, double to) {
        return strokes.keep(
            {horizontal(from, to, 10), horizontal(-8, 0.45, 10), horizontal(0.59, 8, 10)});
    };
    CHECK(between(0.49, 0.55).is_first_kept);
    CHECK(!between(0.51, 0.53).is_first_kept);
    CHECK(!between(0.52, 0.52).is_first_kept);
}

// The side of the square at x = 10 is its outline. It has three pieces, and the one in the middle is a double of a
// longer stroke inside.
TEST_CASE("of an outline and a stroke beside it the outline stays") {
    const StrokesBeforeSquare strokes;
    const auto keep_at = [&](double x) {
        return strokes.keep({vertical(x, 2, 3), vertical(x, 0, 2), vertical(x, 3, 5),
                             vertical(x - 0.05, 0.5, 4.5)});
    };
    CHECK(keep_at(10).is_first_kept);
    CHECK(keep_at(10).count == 3);
    CHECK(!keep_at(9.8).is_first_kept);
    CHECK(keep_at(9.8).count == 3);
    // A stroke inside that is too long for a double stays too.
    CHECK(strokes.keep({vertical(10, 0, 4), vertical(9.95, -5, 5)}).count == 2);
}

TEST_CASE("a short stroke at an outline stays") {
    const StrokesBeforeSquare strokes;
    CHECK(strokes.keep({horizontal(0, 0.5, 9.9)}).count == 0);
    CHECK(strokes.keep({horizontal(0, 0.5, 9.97)}).count == 1);
    CHECK(strokes.keep({horizontal(0, 0.5, -9.97)}).count == 1);
    // Its last fifth is before the background.
    CHECK(strokes.keep({horizontal(8.72, 10.2, 0)}).count == 1);
}

TEST_CASE("the tail of a stroke that branches off a longer one goes") {
    const StrokesBeforeSquare strokes;
    const Polyline longer = horizontal(-8, 8, 0);
    const auto branch = [](double length, double y) {
        return Polyline{{1, y + 0.02}, {2, y + 0.02}, {2 + length, y + 0.02 + 0.5 * length}};
    };
    CHECK(strokes.keep({branch(0.7, 0), longer}).count == 1);
    // Longer than the stubble: it stays without what runs beside the longer one.
    const StrokesBeforeSquare::Kept free = strokes.keep({branch(2.0, 0), longer});
    REQUIRE(free.is_first_kept);
    CHECK(free.from.x > 1.95);
    CHECK(free.from.y < 0.06);
    CHECK(free.to == glm::dvec2(4.0, 1.02));
    // In the other order of its points.
    Polyline turned = branch(2.0, 0);
    std::ranges::reverse(turned);
    const StrokesBeforeSquare::Kept back = strokes.keep({turned, longer});
    CHECK(glm::distance(back.to, free.from) < 1e-12);
    CHECK(back.from == free.to);
    // What runs beside it at both ends, and what is between is as far away as a bow.
    const Polyline bow{{0, 0.02}, {1, 0.02}, {1.5, 0.3}, {2, 0.3}, {2.5, 0.02}, {3.5, 0.02}};
    const StrokesBeforeSquare::Kept middle = strokes.keep({bow, longer});
    CHECK(middle.count == 2);
    CHECK(middle.from.x > 0.95);
    CHECK(middle.to.x < 2.55);
    // Borders and intersections of faces meet others in corners.
    for (const EdgeId edge : {EdgeId{1}, k_no_edge}) {
        const StrokesBeforeSquare::Kept sharp = strokes.keep({branch(2.0, 0), longer}, edge);
        CHECK(sharp.from == glm::dvec2(1, 0.02));
        CHECK(sharp.to == free.to);
    }
    // One that meets the longer line across it, or only crosses it, is whole.
    CHECK(strokes.keep({vertical(1, 0, 3), longer}).from == glm::dvec2(1, 0));
    CHECK(strokes.keep({vertical(1, -0.5, 3), longer}).from == glm::dvec2(1, -0.5));
}

TEST_CASE("a gap of nearly zero leaves tails, and takes no time") {
    const StrokesBeforeSquare strokes;
    const Polyline spur{{0, 0.02}, {2, 0.02}, {2.7, 0.37}};
    CHECK(strokes.keep({spur, horizontal(-8, 8, 0)}, EdgeId{0}, 1e-300).count == 2);
}

TEST_CASE("a tail that is the outline stays") {
    const StrokesBeforeSquare strokes;
    const Polyline longer = horizontal(-8, 8, 9.85);
    const Polyline outer{{1, 9.87}, {2, 9.87}, {2.2, 10}, {2.7, 10}};
    const StrokesBeforeSquare::Kept kept = strokes.keep({outer, longer});
    REQUIRE(kept.is_first_kept);
    CHECK(kept.to == glm::dvec2(2.7, 10));
    Polyline inner = outer;
    for (glm::dvec2& point : inner) point.y -= 5;
    CHECK(strokes.keep({inner, horizontal(-8, 8, 4.85)}).count == 1);
}

}  // namespace
}  // namespace rimline
