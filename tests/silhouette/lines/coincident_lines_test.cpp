#include "silhouette/lines/coincident_lines.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/vec3.hpp>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/lines/against_oracle.h"

namespace rimline {
namespace {

// Each edge has both its ends among the points.
const LineOptions k_each_edge{.splits_counts = true};

// Two faces far to the sides, and in the middle a square of this width, turned so that its sides are oblique to the
// view. In a view along z its sides are 0.8 of the width.
Mesh small_square(float width, float far) {
    const float x = 0.4f * width, z = 0.3f * width, y = 0.5f * width;
    return Mesh(MeshSource{.positions = {{-x, -y, -z},
                                         {x, -y, z},
                                         {x, y, z},
                                         {-x, y, -z},
                                         {-far, -far, 0},
                                         {-far, far, 0},
                                         {-0.9f * far, 0, 0},
                                         {far, -far, 0},
                                         {far, far, 0},
                                         {0.9f * far, 0, 0}},
                           .triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {7, 8, 9}}});
}

TEST_CASE("short lines of a small thing in a large scene are drawn") {
    // A square of 29 mm in a scene of 10 km.
    const Mesh mesh = small_square(0.029f, 7000.0f);
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    for (const bool is_orthographic : {true, false}) {
        CAPTURE(is_orthographic);
        const LineView view = tests::view_of(mesh, {0, 0, 1}, is_orthographic);
        const LineDrawing& drawing =
            drawer.draw(view, brute_force_silhouette(mesh, view.point()), k_each_edge);
        std::uint32_t sides = 0;
        for (const LineRun& run : drawing.runs)
            for (std::uint32_t i = run.first_point; i + 1 < run.last_point; ++i) {
                const LineSource& from = drawing.sources[i];
                if (from.edge != drawing.sources[i + 1].edge) continue;
                if (std::ranges::all_of(mesh.edge(from.edge).vertices,
                                        [](VertexId v) { return index(v) < 4; }))
                    ++sides;
            }
        CHECK(sides == 4);
    }
}

TEST_CASE("lines seen end-on are not drawn, however small the thing") {
    for (const float far : {2.0f, 7000.0f}) {
        CAPTURE(far);
        MeshSource source{.positions = {{-far, -far, 0}, {-far, far, 0}, {-0.9f * far, 0, 0}},
                          .triangles = {{0, 2, 1}}};
        // A plate along the view.
        for (const glm::vec3 p : {glm::vec3(0, 0, 0), {1, 0, 0}, {1, 0, 1}, {0, 0, 1}})
            source.positions.push_back(p);
        source.triangles.push_back({3, 4, 5});
        source.triangles.push_back({3, 5, 6});
        const Mesh mesh(source);
        const LineSurface surface(mesh);
        LineDrawer drawer(surface);
        const LineView view = tests::view_of(mesh, {0, 0, 1}, true);
        const LineDrawing& drawing =
            drawer.draw(view, brute_force_silhouette(mesh, view.point()), k_each_edge);
        double length = 0.0;
        for (const LineRun& run : drawing.runs)
            for (std::uint32_t i = run.first_point; i + 1 < run.last_point; ++i) {
                const EdgeId edge = drawing.sources[i].edge;
                if (edge != drawing.sources[i + 1].edge) continue;
                const auto& [v, w] = mesh.edge(edge).vertices;
                if (index(v) < 3) continue;
                CHECK(mesh.positions()[index(v)].x != mesh.positions()[index(w)].x);
                length += drawing.points[i + 1].arc - drawing.points[i].arc;
            }
        // Of its two sides across the view one is drawn.
        CHECK(length == doctest::Approx(1.0).epsilon(1e-3));
    }
}

}  // namespace
}  // namespace rimline
