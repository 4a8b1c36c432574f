#include "tests/silhouette/lines/against_oracle.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline::tests {

LineView view_of(const Mesh& mesh, const glm::dvec3& direction, bool is_orthographic,
                 double radii) {
    const glm::dvec3 center = mesh.center();
    const glm::dvec3 eye = center + radii * mesh.radius() * glm::normalize(direction);
    return is_orthographic ? LineView::orthographic(eye, center, {0, 1, 0})
                           : LineView::perspective(eye, center, {0, 1, 0});
}

void check_views(const Mesh& mesh, Cameras cameras, std::uint32_t views, std::uint64_t seed,
                 double pixels) {
    CAPTURE(seed);
    Random random(seed);
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    for (std::uint32_t i = 0; i < 2 * views; ++i) {
        CAPTURE(i);
        glm::dvec3 direction(random.in_cube());
        if (cameras == Cameras::axes) {
            direction = glm::dvec3(0.0);
            direction[static_cast<int>(i / 2 % 3)] = i / 2 % 6 < 3 ? 1.0 : -1.0;
        }
        const bool is_orthographic = i % 2 != 0;
        const LineView view =
            view_of(mesh, direction, is_orthographic, cameras == Cameras::inside ? 0.3 : 3.0);
        const LineDrawing& drawing =
            drawer.draw(view, brute_force_silhouette(mesh, view.point()), checkable({}));
        const LineCheck check = check_lines(mesh, view, drawing,
                                            (is_orthographic ? 2.0 * mesh.radius() : 0.7) / pixels);
        CHECK_MESSAGE(check.first_difference.empty(), check.first_difference);
        CHECK(check.wrong == 0);
        CHECK(check.missing_edges == 0);
        CHECK(check.repeated_edges == 0);
        CHECK(drawing.report.failed_checks == 0);
        // From inside a sphere there is no line.
        if (cameras != Cameras::inside) CHECK(check.samples > check.undecided);
    }
}

}  // namespace rimline::tests
