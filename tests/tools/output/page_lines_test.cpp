#include "tools/output/page_lines.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

using namespace rimline;
using tools::PageLine;
using tools::PageLineOptions;
using tools::ViewPlace;

namespace {

// Places on the page are picture coordinates, with y downwards.
constexpr ViewPlace k_place{{0.0, 0.0}, 1.0};

struct MadeDrawing {
    LineDrawing drawing;

    void begin_chain(LineKind kind, bool is_closed) {
        const auto number = static_cast<std::uint32_t>(drawing.chains.size());
        const auto run = static_cast<std::uint32_t>(drawing.runs.size());
        drawing.chains.push_back({run, run, 7 + number, kind, is_closed, 0.0});
    }
    void add_run(std::uint32_t hidden_by, const std::vector<glm::dvec2>& positions) {
        const auto first = static_cast<std::uint32_t>(drawing.points.size());
        double length = 0.0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (i > 0) length += glm::length(positions[i] - positions[i - 1]);
            drawing.points.push_back({positions[i], 1.0, length});
            drawing.sources.push_back({k_no_edge, 0.0f});
        }
        const auto chain = static_cast<std::uint32_t>(drawing.chains.size() - 1);
        drawing.runs.push_back(
            {chain, first, static_cast<std::uint32_t>(drawing.points.size()), hidden_by, length});
        drawing.chains.back().last_run = static_cast<std::uint32_t>(drawing.runs.size());
    }
    struct WholeRun {
        std::uint32_t run;
        bool is_reversed;
    };
    void add_stroke(const std::vector<WholeRun>& runs, bool is_closed) {
        const auto first = static_cast<std::uint32_t>(drawing.stroke_parts.size());
        for (const auto& [run, is_reversed] : runs)
            drawing.stroke_parts.push_back(drawing.whole(run, is_reversed));
        drawing.strokes.push_back(
            {first, static_cast<std::uint32_t>(drawing.stroke_parts.size()), is_closed, 0.0});
    }
    std::vector<PageLine> lines(const PageLineOptions& options = {}) const {
        std::vector<PageLine> lines;
        tools::add_page_lines(drawing, k_place, options, lines);
        return lines;
    }
};

using Points = std::vector<glm::dvec2>;

}  // namespace

TEST_CASE("a stroke is one line through its parts, turned where they are reversed") {
    MadeDrawing made;
    made.begin_chain(LineKind::crease, false);
    made.add_run(0, {{0, 0}, {1, 0}});
    made.begin_chain(LineKind::silhouette, false);
    made.add_run(0, {{5, 0}, {1.1, 0}});
    made.add_stroke({{0, false}, {1, true}}, false);
    const auto lines = made.lines();
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].points == Points{{0, 0}, {1, 0}, {1.1, 0}, {5, 0}});
    CHECK(lines[0].kind == LineKind::silhouette);
    CHECK(lines[0].chains == std::vector<std::uint32_t>{7, 8});
    CHECK(lines[0].length_mm() == doctest::Approx(5.0));
    CHECK_FALSE(lines[0].is_closed);
    CHECK_FALSE(lines[0].is_hidden);
}

TEST_CASE("the last point of a loop is its first one and not written twice") {
    MadeDrawing made;
    made.begin_chain(LineKind::border, true);
    made.add_run(0, {{0, 0}, {2, 0}, {2, -1}, {0, 0}});
    made.add_stroke({{0, false}}, true);
    const auto lines = made.lines();
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].points == Points{{0, 0}, {2, 0}, {2, 1}});
    CHECK(lines[0].is_closed);
    CHECK(lines[0].length_mm() == doctest::Approx(3.0 + std::sqrt(5.0)));
}

TEST_CASE(
    "hidden runs that follow each other are one line, also over the beginning of a closed chain") {
    MadeDrawing made;
    made.begin_chain(LineKind::silhouette, true);
    made.add_run(2, {{0, 0}, {1, 0}});
    made.add_run(0, {{1, 0}, {2, 0}});
    made.add_run(1, {{2, 0}, {2, 3}});
    made.add_run(3, {{2, 3}, {0, 3}});
    made.add_run(1, {{0, 3}, {0, 0}});
    auto lines = made.lines();
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].points == Points{{2, 0}, {2, -3}, {0, -3}, {0, 0}, {1, 0}});
    CHECK(lines[0].is_hidden);
    // Without the run behind three faces and the short one before it.
    lines = made.lines({.hidden_by = 2, .min_length_mm = 3.5, .frame = {}});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].points == Points{{0, -3}, {0, 0}, {1, 0}});
}

TEST_CASE("a chain that is hidden all around is a loop") {
    MadeDrawing made;
    made.begin_chain(LineKind::silhouette, true);
    made.add_run(1, {{0, 0}, {1, 0}, {1, 1}});
    made.add_run(2, {{1, 1}, {0, 0}});
    made.begin_chain(LineKind::silhouette, true);
    made.add_run(1, {{5, 5}, {6, 5}, {6, 6}, {5, 5}});
    const auto lines = made.lines();
    REQUIRE(lines.size() == 2);
    for (const PageLine& line : lines) {
        CHECK(line.is_closed);
        CHECK(line.points.size() == 3);
    }
}

TEST_CASE("hidden runs with a gap between them are two lines") {
    MadeDrawing made;
    made.begin_chain(LineKind::crease, false);
    made.add_run(1, {{0, 0}, {1, 0}});
    made.add_run(1, {{1.5, 0}, {2, 0}});
    CHECK(made.lines().size() == 2);
}

TEST_CASE("lines end at the borders of the frame") {
    MadeDrawing made;
    made.begin_chain(LineKind::silhouette, false);
    made.add_run(0, {{-3, 0.5}, {0.5, 0.5}, {0.5, 4}, {0.75, 4}, {0.75, 0}, {0.8, 0}});
    made.add_stroke({{0, false}}, false);
    made.begin_chain(LineKind::silhouette, false);
    made.add_run(0, {{2, 2}, {3, 3}});
    made.add_stroke({{1, false}}, false);
    const auto lines = made.lines({.frame = {{{0, 0}, {1, 1}}}});
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].points == Points{{0, -0.5}, {0.5, -0.5}, {0.5, -1}});
    CHECK(lines[1].points == Points{{0.75, -1}, {0.75, 0}, {0.8, 0}});
}

TEST_CASE("a loop in the frame stays closed and a loop across its border does not") {
    MadeDrawing made;
    made.begin_chain(LineKind::silhouette, true);
    made.add_run(0, {{0, 0}, {2, 0}, {2, 2}, {0, 0}});
    made.add_stroke({{0, false}}, true);
    auto lines = made.lines({.frame = {{{-1, -1}, {3, 3}}}});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].is_closed);
    lines = made.lines({.frame = {{{-1, -1}, {1, 3}}}});
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].points == Points{{0, 0}, {1, 0}});
    CHECK(lines[1].points == Points{{1, -1}, {0, 0}});
    CHECK_FALSE(lines[0].is_closed);
}

TEST_CASE("points that are one at a thousandth of a millimeter are written once") {
    MadeDrawing made;
    made.begin_chain(LineKind::silhouette, false);
    made.add_run(0, {{0, 0}, {0.0001, 0.0002}, {1.00049, 0}});
    made.add_stroke({{0, false}}, false);
    made.begin_chain(LineKind::silhouette, false);
    made.add_run(0, {{3, 3}, {3.0001, 3}});
    made.add_stroke({{1, false}}, false);
    const auto lines = made.lines();
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].points == Points{{0, 0}, {1, 0}});
}

TEST_CASE("simplification moves no line by more than its tolerance") {
    MadeDrawing made;
    made.begin_chain(LineKind::silhouette, false);
    made.add_run(0, {{0, 0}, {1, 0.09}, {2, 0}, {3, 0.5}, {4, 0}});
    made.add_stroke({{0, false}}, false);
    const auto lines = made.lines({.simplify_mm = 0.1, .frame = {}});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].points == Points{{0, 0}, {2, 0}, {3, -0.5}, {4, 0}});
}

TEST_CASE("curves leave neither the page nor the frame, however large their tolerance is") {
    // Most of an ellipse that touches all borders.
    constexpr double k_width = 40.0, k_height = 12.0;
    MadeDrawing made;
    made.begin_chain(LineKind::silhouette, false);
    Points points;
    for (double angle = 0.0; angle < 6.0; angle += 0.05)
        points.push_back(
            {0.5 * k_width * (1.0 + std::cos(angle)), -0.5 * k_height * (1.0 - std::sin(angle))});
    made.add_run(0, points);
    made.add_stroke({{0, false}}, false);
    const auto outside_mm = [&](const PageLineOptions& options) {
        double most = 0.0;
        for (const PageLine& line : made.lines(options)) {
            REQUIRE(!line.curves.empty());
            glm::dvec2 begin = line.points.front();
            for (const CurvePiece& piece : line.curves) {
                for (int i = 0; i <= 32 && !piece.is_straight; ++i) {
                    const glm::dvec2 p = point_on(piece, begin, i / 32.0);
                    most = std::max({most, -p.x, p.x - k_width, -p.y, p.y - k_height});
                }
                begin = piece.end;
            }
        }
        return most;
    };
    double worst_mm = 0.0;
    for (const double curve_mm : {1.0, 3.0, 9.0, 30.0}) {
        CAPTURE(curve_mm);
        worst_mm = std::max(worst_mm, outside_mm({.curve_mm = curve_mm}));
        CHECK(outside_mm({.curve_mm = curve_mm, .page_mm = glm::dvec2(k_width, k_height)}) <=
              tools::k_max_outside_mm);
        const tools::PictureRectangle frame{{0.0, -k_height}, {k_width, 0.0}};
        CHECK(outside_mm({.curve_mm = curve_mm, .frame = frame}) <= tools::k_max_outside_mm);
    }
    CHECK(worst_mm > 0.3);
}

TEST_CASE("lines are divided where their ink changes, forwards and backwards") {
    // A strip of three squares, each of its own material, but the last of none.
    MeshSource source;
    for (int i = 0; i < 4; ++i)
        for (const float y : {0.0f, 1.0f}) source.positions.emplace_back(float(i), y, 0.0f);
    for (std::uint32_t i = 0; i < 3; ++i) {
        source.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        source.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
        const MaterialId material = i < 2 ? MaterialId{i} : k_no_material;
        source.materials.of_face.insert(source.materials.of_face.end(), 2, material);
    }
    source.materials.materials = {{.base_color = {1, 0, 0}}, {.base_color = {0, 1, 0}}};
    const Mesh mesh(std::move(source));
    const tools::LineMaterials materials(mesh);
    const auto edge_at = [&](float x) {
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
            const auto& [v, w] = mesh.edge(EdgeId{e}).vertices;
            const glm::vec3 sum = mesh.positions()[index(v)] + mesh.positions()[index(w)];
            if (sum == glm::vec3(2.0f * x, 0.0f, 0.0f)) return EdgeId{e};
        }
        return k_no_edge;
    };
    const PageLineOptions options{
        .mesh = &mesh, .materials = &materials, .point = HomogeneousPoint::direction({0, 0, 1})};
    const auto made_of = [&](bool is_reversed, std::uint32_t hidden_by) {
        MadeDrawing made;
        made.begin_chain(LineKind::border, false);
        made.add_run(hidden_by, {{0, 0}, {1, 0}, {2, 0}, {3, 0}});
        for (std::size_t i = 0; i < 4; ++i)
            made.drawing.sources[i] = {edge_at(i == 0 ? 0.5f : float(i) - 0.5f),
                                       i == 0 ? 0.f : 1.f};
        if (hidden_by == 0) made.add_stroke({{0, is_reversed}}, false);
        return made.lines(options);
    };
    for (const std::uint32_t hidden_by : {0u, 1u})
        for (const bool is_reversed : {false, true}) {
            if (hidden_by > 0 && is_reversed) continue;
            CAPTURE(hidden_by);
            CAPTURE(is_reversed);
            auto lines = made_of(is_reversed, hidden_by);
            REQUIRE(lines.size() == 3);
            if (is_reversed) std::swap(lines[0], lines[2]);
            CHECK(lines[0].ink == 0);
            CHECK(lines[1].ink == 1);
            CHECK(lines[2].ink == k_no_material_ink);
            for (std::size_t i = 0; i < 3; ++i) {
                Points expected{{double(i), 0}, {double(i) + 1.0, 0}};
                if (is_reversed) std::swap(expected[0], expected[1]);
                CHECK(lines[i].points == expected);
                CHECK(lines[i].edges.size() == 1);
                CHECK(lines[i].is_hidden == (hidden_by > 0));
                CHECK(lines[i].kind == LineKind::border);
            }
        }
}
