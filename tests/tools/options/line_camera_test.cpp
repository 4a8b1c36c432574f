#include "tools/options/line_camera.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/command.h"
#include "tools/options/sheet_views.h"

using namespace rimline;
using tools::LineCamera;
using tools::LineCameraOptions;
using tools::SheetView;
using tools::ShownPart;

TEST_CASE("the chosen perspective camera holds the model with a margin of 6 percent") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    for (const double fov : {10.0, 35.0, 100.0}) {
        LineCameraOptions options;
        options.fov_degrees = fov;
        const LineCamera camera = options.make_camera("shape:knot", mesh);
        CHECK_FALSE(camera.is_framed);
        const ShownPart shown = shown_part(camera, mesh, 1.0);
        CHECK_FALSE(shown.is_cut);
        const double high = camera.half_height / 1.06, wide = high * 4.0 / 3.0;
        CHECK(std::max({shown.high.x / wide, -shown.low.x / wide, shown.high.y / high,
                        -shown.low.y / high}) == doctest::Approx(1.0));
    }
}

TEST_CASE("a camera in the model shows what its field of view shows") {
    const Mesh mesh(make_built_in_shape("sphere", 1000));
    LineCameraOptions options;
    options.eye = glm::vec3(0.1f, 0.2f, 0.0f);
    options.target = glm::vec3(1.0f, 0.0f, 0.0f);
    const LineCamera camera = options.make_camera("shape:sphere", mesh);
    const ShownPart shown = shown_part(camera, mesh, 2.0);
    CHECK(shown.is_cut);
    CHECK(shown.high.y == doctest::Approx(std::tan(17.5 * 3.14159265358979 / 180.0)));
    CHECK(shown.high.x == doctest::Approx(2.0 * shown.high.y));
    options.eye = options.target;
    CHECK_THROWS_AS(options.make_camera("shape:sphere", mesh), tools::UsageError);
}

TEST_CASE("an orthographic camera shows the model, or the height that is given") {
    const Mesh mesh(make_built_in_shape("box", 12));
    LineCameraOptions options;
    options.is_orthographic = true;
    options.eye = glm::vec3(0.0f, 0.0f, 100.0f);
    options.target = glm::vec3(0.0f);
    ShownPart shown = shown_part(options.make_camera("shape:box", mesh), mesh, 1.0);
    CHECK_FALSE(shown.is_cut);
    double width = 0.0;
    for (const glm::vec3& p : mesh.positions()) width = std::max(width, std::abs(double{p.x}));
    CHECK(shown.high.x == doctest::Approx(width));
    options.ortho_height = 0.5;
    shown = shown_part(options.make_camera("shape:box", mesh), mesh, 3.0);
    CHECK(shown.is_cut);
    CHECK(shown.high.y == doctest::Approx(0.25));
    CHECK(shown.high.x == doctest::Approx(0.75));
}

TEST_CASE("the front of a sheet is seen from +z, and its top lies behind it") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const glm::dvec3 up(0, 1, 0), z_up(0, 0, 1);
    CHECK(sheet_camera(SheetView::front, mesh, up).view.forward() == glm::dvec3(0, 0, -1));
    CHECK(sheet_camera(SheetView::right, mesh, up).view.forward() == glm::dvec3(-1, 0, 0));
    const LineView top = sheet_camera(SheetView::top, mesh, up).view;
    CHECK(top.forward() == glm::dvec3(0, -1, 0));
    CHECK(top.right() == glm::dvec3(1, 0, 0));
    CHECK(top.up() == glm::dvec3(0, 0, -1));
    const LineView bottom = sheet_camera(SheetView::bottom, mesh, up).view;
    CHECK(bottom.right() == glm::dvec3(1, 0, 0));
    const LineView front = sheet_camera(SheetView::front, mesh, z_up).view;
    CHECK(front.forward() == glm::dvec3(0, 1, 0));
    CHECK(front.right() == glm::dvec3(1, 0, 0));
    // Each view turns the front by a right angle around an edge of the sheet.
    for (const SheetView view :
         {SheetView::front, SheetView::right, SheetView::left, SheetView::back})
        CHECK(sheet_camera(view, mesh, up).view.up() == up);
    const glm::dvec3 iso = sheet_camera(SheetView::iso, mesh, up).view.forward();
    CHECK(glm::length(iso - glm::normalize(glm::dvec3(-1, -1, -1))) < 1e-12);
}
