#include "tools/bench/line_views.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline::tools {
namespace {

TEST_CASE("views surround the model at one distance and fill the page") {
    const Mesh mesh(make_built_in_shape("torus", 2000));
    const std::vector<BenchView> views = bench_views(mesh, 21);
    REQUIRE(views.size() == 21);
    glm::dvec3 mean(0.0);
    for (const BenchView& view : views) {
        const glm::dvec3 eye = glm::dvec3(view.view.point().xyz()) - mesh.center();
        CHECK(glm::length(eye) == doctest::Approx(3.3 * mesh.radius()).epsilon(1e-5));
        mean += glm::normalize(eye) / 21.0;
        glm::dvec2 low(std::numeric_limits<double>::max()), high = -low;
        for (const glm::vec3& position : mesh.positions()) {
            const glm::dvec2 p = view.view.project(glm::dvec3(position)).position;
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        const glm::dvec2 size_mm = view.mm_per_unit * (high - low);
        CHECK(std::max(size_mm.x / 190.0, size_mm.y / 277.0) == doctest::Approx(1.0));
    }
    CHECK(glm::length(mean) < 0.5);
    // The first views do not depend on how many there are.
    CHECK(bench_views(mesh, 3)[2].mm_per_unit == views[2].mm_per_unit);
}

}  // namespace
}  // namespace rimline::tools
