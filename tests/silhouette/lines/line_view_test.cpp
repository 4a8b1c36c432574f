#include "silhouette/lines/line_view.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {

namespace {

LineDrawing draw_from(const Mesh& mesh, const LineView& view, const LineOptions& options = {}) {
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    return drawer.draw(view, brute_force_silhouette(mesh, view.point()), options);
}

double visible_length(const LineDrawing& drawing) {
    double length = 0.0;
    for (const LineRun& run : drawing.runs)
        if (run.is_visible()) length += run.length;
    return length;
}

double distance_to_point(const LineView& view) {
    return glm::distance(glm::dvec3(view.point().xyz()), view.eye());
}

}  // namespace

TEST_CASE("up may have any length, and another axis takes the place of one along the view") {
    const glm::dvec3 eye(1, 2, 3), target(0, 0, 0);
    const glm::dvec3 up = LineView::perspective(eye, target, {0, 0, 1}).up();
    for (const double length : {1e-300, 1e-200, 1e-150, 1e10, 1e200, 1e300})
        CHECK(glm::distance(LineView::perspective(eye, target, {0, 0, length}).up(), up) < 1e-12);
    const glm::dvec3 other = LineView::perspective(eye, target, eye).up();
    CHECK(std::abs(glm::dot(other, eye)) < 1e-12);
    CHECK(LineView::perspective(eye, target, {0, 0, 0}).up() == other);
    const LineView near = LineView::orthographic({1e-200, 0, 0}, {0, 0, 0}, {0, 1, 0});
    CHECK(near.forward() == glm::dvec3(-1, 0, 0));
}

TEST_CASE("the point lies beside the eye by a share of the distance of what is drawn") {
    const glm::dvec3 eye(0, 0, 4), up(0, 1, 0);
    const LineView usual = LineView::perspective(eye, {0, 0, 0}, up);
    CHECK(usual.shift() == 4.0 * LineView::k_shift);
    CHECK(distance_to_point(usual) == doctest::Approx(usual.shift()).epsilon(0.1));
    // The target may be far behind what is drawn, or before it.
    for (const double target : {-1e9, -1e3, 3.999}) {
        const LineView view = LineView::perspective(eye, {0, 0, target}, up, 4.0);
        CHECK(view.point() == usual.point());
        CHECK(view.shift() == usual.shift());
    }
    CHECK(LineView::perspective(eye, {0, 0, -996}, up).shift() == 1000.0 * LineView::k_shift);
}

TEST_CASE("the point is not the eye far from the origin") {
    for (const double offset : {64.0, 256.0, 1000.0}) {
        const glm::dvec3 center(offset);
        for (const glm::dvec3 direction : {glm::dvec3(0, 0, 4), glm::dvec3(3, 0, 3)}) {
            const LineView view = LineView::perspective(center + direction, center, {0, 1, 0});
            const glm::dvec3 moved = glm::dvec3(view.point().xyz()) - view.eye();
            // Off the planes through the eye that are upright or level.
            CHECK(glm::dot(moved, view.right()) > 0.0);
            CHECK(glm::dot(moved, view.up()) > 0.0);
            CHECK(glm::length(moved) < 0x1p-15 * 4.3);
        }
    }
}

TEST_CASE("a mesh far from the origin is drawn as at the origin") {
    MeshSource source = make_built_in_shape("scene", 600);
    for (glm::vec3& p : source.positions) p = glm::round(p * 128.0f) / 128.0f;
    const Mesh mesh(source);
    // Floats there are as far from each other as a part of a pixel.
    for (const auto& [offset, within] : {std::pair(64.0f, 1e-3), std::pair(512.0f, 2e-3)}) {
        MeshSource moved_source = source;
        for (glm::vec3& p : moved_source.positions) p += glm::vec3(offset);
        const Mesh moved(moved_source);
        for (const glm::dvec3 direction : {glm::dvec3(0, 0, 4), glm::dvec3(3, 0, 3)}) {
            const glm::dvec3 center(0.0);
            const LineDrawing here =
                draw_from(mesh, LineView::perspective(center + direction, center, {0, 1, 0}));
            const glm::dvec3 there = center + glm::dvec3(double{offset});
            const LineDrawing far =
                draw_from(moved, LineView::perspective(there + direction, there, {0, 1, 0}));
            CHECK(far.report.undecided_lines == 0);
            CHECK(visible_length(far) == doctest::Approx(visible_length(here)).epsilon(within));
        }
    }
}

TEST_CASE("a mesh far from the eye has the lines of one that is near") {
    for (const char* shape : {"knot", "spring", "scene"}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, 2000));
        const glm::dvec3 direction = mesh.radius() * glm::normalize(glm::dvec3(3, 2, 1));
        std::array<double, 2> near{};
        for (const double radii : {30.0, 300.0, 3000.0, 30000.0}) {
            CAPTURE(radii);
            const LineView view =
                LineView::perspective(mesh.center() + radii * direction, mesh.center(), {0, 1, 0});
            for (const bool keeps : {false, true}) {
                const LineDrawing drawing = draw_from(mesh, view, {.keeps_coincident = keeps});
                CHECK(drawing.report.failed_checks == 0);
                const double length = radii * visible_length(drawing);
                double& first = near[keeps ? 1 : 0];
                if (first == 0.0) first = length;
                CHECK(length == doctest::Approx(first).epsilon(0.03));
            }
        }
        // What coincides is little.
        CHECK(near[0] > 0.95 * near[1]);
        CHECK(near[0] <= near[1] * (1.0 + 1e-9));
    }
}

TEST_CASE("the distance of what is drawn is at least its radius") {
    const Mesh mesh(make_built_in_shape("box", 12));
    CHECK(drawn_distance(mesh, mesh.center()) == mesh.radius());
    CHECK(drawn_distance(mesh, mesh.center() + glm::dvec3(0, 9, 0)) == doctest::Approx(9.0));
}

}  // namespace rimline
