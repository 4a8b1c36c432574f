#include "silhouette/lines/fitted_eye.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

TEST_CASE("a fitted lens holds all positions with the margin, in the middle of the picture") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    for (const double aspect : {0.5, 1.0, 1.7})
        for (const glm::dvec3 direction : {glm::dvec3(3, 2, 4), {0, 1, 0}, {-1, -1, 2}}) {
            const glm::dvec3 eye = mesh.center() + 2.0 * mesh.radius() * glm::normalize(direction);
            const std::optional<FittedLens> lens =
                fit_lens(mesh.positions(), mesh.center(), eye, {0, 1, 0}, aspect);
            REQUIRE(lens);
            const LineView view = LineView::perspective(eye, lens->target, lens->up);
            glm::dvec2 low(1e9), high(-1e9);
            for (const glm::vec3& position : mesh.positions()) {
                const glm::dvec2 p = view.project(glm::dvec3(position)).position;
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            CHECK(glm::length(low + high) < 1e-3);
            CHECK(k_picture_margin * std::max(high.y, high.x / aspect) ==
                  doctest::Approx(lens->tangent).epsilon(1e-3));
            // Along the up axis too, up is not along the view.
            CHECK(glm::length(glm::cross(glm::normalize(lens->up), view.forward())) > 0.15);
        }
}

TEST_CASE(
    "there is no lens where a position lies behind the eye or far aside, or where there is none") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const glm::dvec3 up(0, 1, 0);
    CHECK_FALSE(fit_lens(mesh.positions(), mesh.center(), {0.1, 0.2, 0.0}, up, 1.0));
    CHECK_FALSE(fit_lens(mesh.positions(), mesh.center(), {0.0, 0.0, 1.0001}, up, 1.0));
    CHECK_FALSE(fit_lens(mesh.positions(), mesh.center(), mesh.center(), up, 1.0));
    CHECK_FALSE(fit_lens({}, {0, 0, 0}, {0, 0, 1}, up, 1.0));
    CHECK(fit_lens(mesh.positions(), mesh.center(), {0.0, 0.0, 3.0}, up, 1.0));
}

}  // namespace
}  // namespace rimline
