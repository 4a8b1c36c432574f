#include "tools/output/line_projection.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

using namespace rimline;
using tools::LineProjection;
using tools::PictureFit;
using tools::PictureFrame;
using tools::PictureLine;

namespace {

// Center 0; up y.
Mesh octahedron() {
    MeshSource source;
    source.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (std::uint32_t i = 0; i < 8; ++i)
        source.triangles.push_back({i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2)});
    return Mesh(source);
}

void check_near(const glm::dvec2& a, const glm::dvec2& b) {
    CHECK(a.x == doctest::Approx(b.x));
    CHECK(a.y == doctest::Approx(b.y));
}

}  // namespace

TEST_CASE("a viewpoint sees tangents, right to the right and up above") {
    const Mesh mesh = octahedron();
    const LineProjection projection(mesh, HomogeneousPoint::viewpoint({0, 0, 4}));
    const auto line = projection.project({1, 0, 0}, {0, 2, 2});
    REQUIRE(line.has_value());
    check_near(line->a, {0.25, 0.0});
    check_near(line->b, {0.0, 1.0});
}

TEST_CASE("a direction sees lengths, from the side it points to") {
    const Mesh mesh = octahedron();
    const LineProjection projection(mesh, HomogeneousPoint::direction({5, 0, 0}));
    const auto line = projection.project({-7, 0, 3}, {100, 2, 0});
    REQUIRE(line.has_value());
    check_near(line->a, {-3.0, 0.0});
    check_near(line->b, {0.0, 2.0});
}

TEST_CASE("looking along up takes another up") {
    const Mesh mesh = octahedron();
    const LineProjection projection(mesh, HomogeneousPoint::direction({0, 1, 0}));
    const auto line = projection.project({1, 0, 0}, {0, 0, 1});
    REQUIRE(line.has_value());
    CHECK(glm::length(line->a) == doctest::Approx(1.0));
    CHECK(glm::length(line->b) == doctest::Approx(1.0));
}

TEST_CASE("what lies behind a viewpoint is cut away, and the rest ends at 75 degrees") {
    const Mesh mesh = octahedron();
    const LineProjection projection(mesh, HomogeneousPoint::viewpoint({0, 0, 4}));
    const double limit = std::tan(75.0 * std::acos(-1.0) / 180.0);
    CHECK_FALSE(projection.project({0, 0, 5}, {1, 1, 9}).has_value());
    CHECK_FALSE(projection.project({100, 0, 3}, {100, 5, 3}).has_value());
    const auto line = projection.project({1, 0, 0}, {1, 0, 8});
    REQUIRE(line.has_value());
    check_near(line->a, {0.25, 0.0});
    check_near(line->b, {limit, 0.0});
    // Through the viewpoint itself, and from it: nothing infinite.
    CHECK_FALSE(projection.project({0, 0, 4}, {0, 0, 4}).has_value());
    for (const glm::vec3 end : {glm::vec3(0, 0, 0), glm::vec3(3, 2, 1)})
        if (const auto seen = projection.project({0, 0, 4}, end))
            CHECK(std::isfinite(glm::length(seen->a) + glm::length(seen->b)));
}

TEST_CASE("a viewpoint at the center still has a picture") {
    const Mesh mesh = octahedron();
    const LineProjection projection(mesh, HomogeneousPoint::viewpoint({0, 0, 0}));
    const auto line = projection.project({1, 0, -1}, {0, 1, -1});
    REQUIRE(line.has_value());
    check_near(line->a, {1.0, 0.0});
    check_near(line->b, {0.0, 1.0});
}

TEST_CASE("a picture fits its view box, upright") {
    PictureFrame frame;
    frame.include({{-1, 3}, {3, 5}});
    const PictureFit fit = frame.fit();
    CHECK(fit.width == doctest::Approx(1000.0));
    CHECK(fit.height == doctest::Approx(fit.scale * 2.0 + 2.0 * fit.margin));
    const PictureLine line = fit.to_view({{-1, 3}, {3, 5}});
    check_near(line.a, {fit.margin, fit.height - fit.margin});
    check_near(line.b, {fit.width - fit.margin, fit.margin});
    CHECK(PictureFrame().fit().width > 0.0);
    PictureFrame point;
    point.include({{2, 2}, {2, 2}});
    CHECK(std::isfinite(point.fit().scale));
}
