#include "tools/output/pen_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

using namespace rimline;
using namespace rimline::tools;

namespace {

PageLine line_of(std::vector<glm::dvec2> points, bool is_closed = false) {
    PageLine line{.kind = LineKind::silhouette,
                  .is_hidden = false,
                  .is_closed = is_closed,
                  .points = std::move(points)};
    line.curves = fit_curves(line.points, is_closed, 0.05);
    return line;
}

// Between lines, from the corner of the page on.
double travel_of(const std::vector<PageLine>& lines) {
    glm::dvec2 pen(0.0);
    double travel = 0.0;
    for (const PageLine& line : lines) {
        travel += glm::distance(pen, line.points.front());
        pen = line.is_closed ? line.points.front() : line.points.back();
    }
    return travel;
}

// Sixteen places of each curve.
std::vector<std::array<double, 2>> places_of(const PageLine& line) {
    std::vector<std::array<double, 2>> places;
    glm::dvec2 begin = line.points.front();
    for (const CurvePiece& piece : line.curves) {
        for (int i = 0; i <= 16; ++i) {
            const glm::dvec2 p = point_on(piece, begin, i / 16.0);
            places.push_back({std::round(1e6 * p.x), std::round(1e6 * p.y)});
        }
        begin = piece.end;
    }
    std::ranges::sort(places);
    return places;
}

std::vector<PageLine> scattered(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0.0, 200.0), step(-6.0, 6.0);
    std::vector<PageLine> lines;
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<glm::dvec2> points{{place(random), place(random)}};
        for (int k = 0; k < 5; ++k)
            points.push_back(points.back() + glm::dvec2(step(random), step(random)));
        lines.push_back(line_of(std::move(points), i % 7 == 0));
        lines.back().chains = {static_cast<std::uint32_t>(i), 1'000'000};
        lines.back().edges = {{static_cast<std::uint32_t>(i), 1}, {2, 3}};
    }
    return lines;
}

}  // namespace

TEST_CASE("a pen draws the same lines with little way between them") {
    const std::vector<PageLine> lines = scattered(600);
    std::vector<PageLine> ordered = lines;
    order_for_pen(ordered);
    REQUIRE(ordered.size() == lines.size());
    CHECK(travel_of(ordered) < 0.15 * travel_of(lines));
    std::size_t turned = 0;
    std::vector<bool> found(lines.size());
    for (const PageLine& line : ordered) {
        const bool is_turned = line.chains.front() == 1'000'000;
        const std::uint32_t number = is_turned ? line.chains.back() : line.chains.front();
        REQUIRE_FALSE(found[number]);
        found[number] = true;
        const PageLine& before = lines[number];
        CHECK(line.edges.front()[0] == (is_turned ? 2 : number));
        CHECK(line.is_closed == before.is_closed);
        CHECK(line.points.front() == (is_turned ? before.points.back() : before.points.front()));
        CHECK(places_of(line) == places_of(before));
        turned += is_turned;
    }
    CHECK(turned > 100);
}

TEST_CASE("each time the line with the nearest end comes next, in its layer, kind and ink") {
    std::vector<PageLine> lines = scattered(150);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        lines[i].is_hidden = i % 2 == 0;
        lines[i].kind = i % 3 == 0 ? LineKind::crease : LineKind::silhouette;
        lines[i].ink = static_cast<std::uint8_t>(i % 5);
    }
    order_for_pen(lines);
    const auto group = [](const PageLine& line) {
        return std::tuple(line.is_hidden, line.kind, line.ink);
    };
    CHECK(std::ranges::is_sorted(lines, {}, group));
    glm::dvec2 pen(0.0);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double way = glm::distance(pen, lines[i].points.front());
        for (std::size_t k = i; k < lines.size() && group(lines[k]) == group(lines[i]); ++k) {
            CHECK(glm::distance(pen, lines[k].points.front()) >= way);
            if (!lines[k].is_closed) CHECK(glm::distance(pen, lines[k].points.back()) >= way);
        }
        pen = lines[i].is_closed ? lines[i].points.front() : lines[i].points.back();
    }
}

TEST_CASE("no lines, one line and lines of one place have an order") {
    std::vector<PageLine> lines;
    order_for_pen(lines);
    CHECK(lines.empty());
    for (int count = 1; count < 4; ++count) {
        lines.push_back(line_of({{5, 5}, {5.001, 5}}));
        order_for_pen(lines);
        CHECK(lines.size() == std::size_t(count));
    }
}
