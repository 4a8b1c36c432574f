// What pictures of point clouds are made of.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/clouds/disc_pieces.h"
#include "engine/clouds/disc_radii.h"
#include "silhouette/mesh/any_perpendicular.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/points/feature_weights.h"
#include "tests/silhouette/points/sample_clouds.h"
#include "tools/output/cloud_drawing.h"
#include "tools/output/hidden_points.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

// Two lattices that meet at a right angle in x = 0; z = 0 or x = 0.
std::vector<glm::dvec3> make_fold(int n) {
    std::vector<glm::dvec3> points;
    for (int i = -n; i <= n; ++i)
        for (int y = 0; y <= 2 * n; ++y) points.emplace_back(std::min(i, 0), y, std::max(i, 0));
    return points;
}

}  // namespace

TEST_CASE("of a sphere's points those before its horizon are seen") {
    const std::vector<glm::dvec3> points = tests::make_sphere(4000);
    const glm::dvec3 eye(0.0, 0.0, 4.0);
    const double horizon = 0.25;  // cos of the angle at the center: radius over distance.
    const std::vector<std::uint32_t> seen = visible_points(points, eye);
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const bool is_seen = std::ranges::binary_search(seen, p);
        CAPTURE(points[p].z);
        if (points[p].z > horizon + 0.1) CHECK(is_seen);
        if (points[p].z < horizon - 0.1) CHECK(!is_seen);
    }
}

TEST_CASE("clouds without a hull are seen whole, wherever the viewpoint is") {
    CHECK(visible_points({}, {1, 2, 3}).empty());
    const std::vector<glm::dvec3> three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    CHECK(visible_points(three, {0, 0, 0}).size() == 3);
    const std::vector<glm::dvec3> same(9, glm::dvec3(1, 2, 3));
    CHECK(visible_points(same, {1, 2, 3}).size() == 9);
    std::vector<glm::dvec3> line;
    for (int i = 0; i < 20; ++i) line.push_back({double(i), 0.0, 0.0});
    CHECK(visible_points(line, {30, 0, 0}).size() == 20);
}

TEST_CASE("discs on a lattice are as wide as half a cell's diagonal") {
    const PointSurface surface(tests::make_patch(17, 0.0, 1).points);
    for (const double radius : disc_radii(surface))
        CHECK(radius == doctest::Approx(std::sqrt(0.5) / 16.0));
}

TEST_CASE("discs are wider where the surface bends, by the sine of the angle") {
    // A lattice around a cylinder: triangles lie 10 degrees from the normals between them.
    constexpr double k_step_rad = 20.0 * std::numbers::pi / 180.0;
    const double side = 2.0 * std::sin(0.5 * k_step_rad);
    std::vector<glm::dvec3> points;
    for (int around = 0; around < 18; ++around)
        for (int along = 0; along < 12; ++along)
            points.push_back(
                {std::cos(k_step_rad * around), std::sin(k_step_rad * around), side * along});
    const std::vector<double> radii = disc_radii(PointSurface(points));
    const double flat = std::sqrt(0.5) * side;
    for (std::size_t p = 0; p < points.size(); ++p) {
        CAPTURE(p);
        CHECK(radii[p] == doctest::Approx(flat * (1.0 + std::sin(0.5 * k_step_rad))).epsilon(0.03));
    }
}

TEST_CASE("discs cover a jittered patch") {
    const tests::Patch patch = tests::make_patch(20, 0.3, 4);
    const PointSurface surface(patch.points);
    const std::vector<double> radii = disc_radii(surface);
    for (int x = 0; x <= 200; ++x)
        for (int y = 0; y <= 200; ++y) {
            const glm::dvec3 at(x / 200.0, y / 200.0, 0.0);
            bool is_covered = false;
            for (std::size_t p = 0; p < radii.size(); ++p)
                is_covered =
                    is_covered || glm::distance(at, patch.points[p]) <= radii[p] * 1.000001;
            CAPTURE(x);
            CAPTURE(y);
            CHECK(is_covered);
        }
}

TEST_CASE("points without umbrellas have the discs that points usually have") {
    CHECK(disc_radii(PointSurface({})).empty());
    CHECK(disc_radii(PointSurface(std::vector<glm::dvec3>{{1, 2, 3}})) == std::vector<double>{0.0});
    std::vector<glm::dvec3> points = tests::make_patch(17, 0.0, 1).points;
    points.emplace_back(50.0, 50.0, 50.0);
    const PointSurface surface(points);
    REQUIRE(surface.label(PointId{17 * 17}) == PointLabel::undecided);
    CHECK(disc_radii(surface).back() == doctest::Approx(std::sqrt(0.5) / 16.0));
}

TEST_CASE("a flat point has one disc and a fold's edge two, each cut where the other begins") {
    const int n = 6;
    const std::vector<glm::dvec3> points = make_fold(n);
    const PointSurface surface(points);
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const glm::dvec3& at = points[p];
        if (at.y < 2.0 || at.y > 2 * n - 2.0) continue;
        CAPTURE(p);
        const std::vector<DiscPiece> pieces = disc_pieces(surface, PointId{p});
        const bool is_inside = at.x > -n + 0.5 && at.z < n - 0.5;
        if (is_inside && (at.x <= -2.0 || at.z >= 2.0)) {
            REQUIRE(pieces.size() == 1);
            CHECK(pieces[0].cuts[0] == glm::dvec3(0.0));
        }
        if (at.x != 0.0 || at.z != 0.0) continue;
        REQUIRE(pieces.size() == 2);
        for (const DiscPiece& piece : pieces) {
            // The face z = 0 lies where x is negative, the face x = 0 where z is positive.
            const bool is_flat = std::abs(piece.normal.z) > 0.5;
            CHECK(std::abs(is_flat ? piece.normal.z : piece.normal.x) > 1.0 - 1e-9);
            CHECK((is_flat ? -piece.cuts[0].x : piece.cuts[0].z) > 1.0 - 1e-9);
            CHECK(piece.cuts[1] == glm::dvec3(0.0));
        }
    }
}

TEST_CASE("where a crease ends at a border, its discs do too") {
    const int n = 6;
    const std::vector<glm::dvec3> points = make_fold(n);
    const PointSurface surface(points);
    std::size_t ends = 0;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const glm::dvec3& at = points[p];
        if (at.x != 0.0 || at.z != 0.0 || (at.y > 0.0 && at.y < 2 * n)) continue;
        if (surface.label(PointId{p}) != PointLabel::border) continue;
        const std::vector<DiscPiece> pieces = disc_pieces(surface, PointId{p});
        if (pieces.size() < 2) continue;  // Of one side of the fold alone.
        ++ends;
        const glm::dvec3 outward(0.0, at.y == 0.0 ? -1.0 : 1.0, 0.0);
        for (const DiscPiece& piece : pieces)
            CHECK(std::ranges::any_of(
                piece.cuts, [&](const glm::dvec3& cut) { return glm::dot(cut, outward) < -0.99; }));
    }
    CHECK(ends > 0);
}

TEST_CASE("the camera's frame holds every disc, and a coarse cloud has dots for discs") {
    const PointCloud cloud(points_of(make_built_in_shape("terrain", 2'000)));
    const PointSurface surface(cloud.positions());
    const UmbrellaIndex umbrellas(surface);
    const std::vector<float> weights = feature_weights(surface);
    const PointColor paper{248, 244, 236};
    CHECK(usual_look(surface.size()) == CloudLook::dots);
    CHECK(usual_look(5000) == CloudLook::discs);

    const CloudDrawing dots(cloud, surface, umbrellas, weights, CloudLook::dots);
    const SplatCloud dotted = dots.drawn(paper);
    std::size_t round = 0;
    for (const gpu::StrokeRecord& stroke : dotted.strokes) round += stroke.from == stroke.to;
    CHECK(round == surface.size());
    // Discs only hide.
    for (const gpu::SplatRecord& splat : dotted.splats) CHECK(splat.color == packed(paper, false));

    const CloudDrawing drawing(cloud, surface, umbrellas, weights, CloudLook::discs);
    PictureOptions options;
    options.size = {800, 600};
    for (const glm::dvec3& eye : {glm::dvec3(2, 1, 2), glm::dvec3(-1, 3, 0.5)}) {
        const Camera camera =
            make_cloud_camera(drawing, umbrellas, "terrain", eye, std::nullopt, options);
        const glm::dmat3 axes = camera_from_world(camera);
        const Projection projection = make_projection(
            camera, 800.0 / 600.0, drawing.subject().center, drawing.subject().radius);
        for (const gpu::SplatRecord& splat : drawing.drawn(paper).splats) {
            const glm::dvec3 normal(splat.normal);
            if (normal == glm::dvec3(0.0)) continue;
            const glm::dvec3 u = any_perpendicular(normal), v = glm::cross(normal, u);
            for (int turn = 0; turn < 16; ++turn) {
                const double angle = turn * std::numbers::pi / 8.0;
                const glm::dvec3 rim =
                    glm::dvec3(splat.position) +
                    double(splat.radius) * (std::cos(angle) * u + std::sin(angle) * v);
                const glm::dvec3 at = axes * (rim - camera.eye);
                CHECK(std::abs(projection.scale.x * at.x / -at.z) <= 1.0);
                CHECK(std::abs(projection.scale.y * at.y / -at.z) <= 1.0);
            }
        }
    }
}

TEST_CASE("paper discs hide the dots of a sphere's back and hardly any of its front") {
    tests::Random random(1);
    std::vector<glm::dvec3> points;
    while (points.size() < 400) {
        const glm::dvec3 p(tests::jitter(random), tests::jitter(random), tests::jitter(random));
        if (glm::length(p) > 0.1 && glm::length(p) < 1.0) points.push_back(glm::normalize(p));
    }
    PointSource source;
    source.positions = points;
    const PointCloud cloud(source);
    const PointSurface surface(cloud.positions());
    const UmbrellaIndex umbrellas(surface);
    const std::vector<float> weights = feature_weights(surface);
    const CloudDrawing drawing(cloud, surface, umbrellas, weights, CloudLook::dots);
    const SplatCloud drawn = drawing.drawn({248, 244, 236});
    // Seen along z from infinity.
    const auto is_hidden = [&](const gpu::StrokeRecord& dot) {
        return std::ranges::any_of(drawn.splats, [&](const gpu::SplatRecord& disc) {
            const glm::dvec2 aside(dot.from - disc.position);
            const glm::dvec3 normal(disc.normal);
            const glm::dvec3 to(aside, -glm::dot(aside, glm::dvec2(normal)) / normal.z);
            const double share = glm::length(to) / double{disc.radius};
            // As in splat.vert, a disc is a cone.
            return share <= 1.0 && disc.position.z + to.z - 0.15 * share * double{disc.radius} >
                                       dot.from.z + dot.lifts.x;
        });
    };
    int front = 0, hidden_front = 0, back = 0, shown_back = 0;
    for (const gpu::StrokeRecord& dot : drawn.strokes) {
        if (dot.from != dot.to) continue;
        const double height = (double{dot.from.z} - umbrellas.center().z) / umbrellas.radius();
        if (height > 0.05) hidden_front += is_hidden(dot), ++front;
        if (height < -0.3) shown_back += !is_hidden(dot), ++back;
    }
    CHECK(front > 150);
    CHECK(back > 120);
    // With discs on the surface and half of their own radii as lifts, 34 of 191.
    CHECK(hidden_front <= front / 40);
    CHECK(shown_back <= 1);
}

TEST_CASE("a patch's discs end at its border") {
    const int n = 12;
    const tests::Patch patch = tests::make_patch(n, 0.0, 1);
    const PointSurface surface(patch.points);
    for (std::uint32_t p = 0; p < patch.points.size(); ++p) {
        const glm::dvec3& at = patch.points[p];
        const std::vector<DiscPiece> pieces = disc_pieces(surface, PointId{p});
        REQUIRE(pieces.size() == 1);
        const auto keeps = [&](const glm::dvec3& step) {
            for (const glm::dvec3& cut : pieces[0].cuts)
                if (glm::dot(cut, step) < -1e-12) return false;
            return true;
        };
        CAPTURE(p);
        for (int turn = 0; turn < 16; ++turn) {
            const double angle = (turn + 0.5) * std::numbers::pi / 8.0;
            const glm::dvec3 step(0.01 * std::cos(angle), 0.01 * std::sin(angle), 0.0);
            const glm::dvec3 to = at + step;
            CHECK(keeps(step) == (to.x >= 0.0 && to.x <= 1.0 && to.y >= 0.0 && to.y <= 1.0));
        }
    }
}

TEST_CASE("a point without an umbrella has a disc without a normal") {
    const std::vector<DiscPiece> pieces =
        disc_pieces(PointSurface(std::vector<glm::dvec3>{{1, 2, 3}}), PointId{0});
    REQUIRE(pieces.size() == 1);
    CHECK(pieces[0].normal == glm::dvec3(0.0));
    CHECK(pieces[0].cuts[0] == glm::dvec3(0.0));
}
