// Tiny meshes of small coordinates, where much coincides, from any camera: a drawing of lines against its oracle.

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_oracle.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/mesh.h"
#include "tests/fuzz/fuzz_input.h"

using namespace rimline;

namespace {

glm::dvec3 small_point(fuzz::FuzzInput& input) {
    const auto coordinate = [&] { return (double(input.byte()) - 128.0) / 8.0; };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::FuzzInput input(data, size);
    MeshSource source = input.mesh(16);
    // The oracle decides in long double what is of similar size.
    for (glm::vec3& position : source.positions) position = glm::vec3(small_point(input));
    const Mesh mesh(source);
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    for (int view = 0; view < 4; ++view) {
        const bool is_orthographic = input.byte() % 2 == 0;
        // Beside the mesh's lattice: what is nearer to the eye than a hundred-thousandth of the radius is cut off, and
        // hides nothing (LineDrawer::draw()).
        const glm::dvec3 eye = small_point(input) + glm::dvec3(0.0137, 0.0251, 0.0313);
        const glm::dvec3 target = small_point(input);
        if (glm::distance(eye, target) < 0.1) continue;
        const glm::dvec3 up(0.0, 1.0, 0.01);
        const LineView seen = is_orthographic ? LineView::orthographic(eye, target, up)
                                              : LineView::perspective(eye, target, up);
        const LineDrawing& drawing =
            drawer.draw(seen, brute_force_silhouette(mesh, seen.point()), checkable({}));
        const LineCheck check =
            check_lines(mesh, seen, drawing, is_orthographic ? mesh.radius() / 64.0 + 1e-3 : 0.02);
        if (check.wrong + check.missing_edges + check.repeated_edges > 0)
            fuzz::fail(check.first_difference);
        fuzz::require(drawing.report.failed_checks == 0, "a cycle of lines contradicts itself");
    }
    return 0;
}
