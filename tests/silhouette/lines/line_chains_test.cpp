#include "silhouette/lines/line_chains.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <utility>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/lines/against_oracle.h"

namespace rimline {
namespace {

void add_block(MeshSource& source, const glm::vec3& low, const glm::vec3& high) {
    constexpr std::uint32_t k_sides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                             {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    const auto first = static_cast<std::uint32_t>(source.positions.size());
    for (int corner = 0; corner < 8; ++corner)
        source.positions.emplace_back((corner & 4 ? high : low).x, (corner & 2 ? high : low).y,
                                      (corner & 1 ? high : low).z);
    for (const auto& [a, b, c, d] : k_sides) {
        source.triangles.push_back({first + a, first + b, first + c});
        source.triangles.push_back({first + a, first + c, first + d});
    }
}

// A plate with a peg through it, from the side of the peg. Where the peg comes out of the plate, its sides are seen
// edge-on: the curve there lies below the outline of the peg's end.
TEST_CASE("a curve that another line covers is no line, and leaves no runs without length") {
    MeshSource source;
    add_block(source, {-2, -2, -0.25f}, {2, 2, 0.25f});
    add_block(source, {-1, -1, -1}, {1, 1, 1});
    const Mesh mesh(source);
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    for (const glm::dvec3 direction : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)})
        for (const bool splits : {false, true}) {
            CAPTURE(splits);
            const LineView view = tests::view_of(mesh, direction, true);
            const LineDrawing& drawing = drawer.draw(
                view, brute_force_silhouette(mesh, view.point()), {.splits_counts = splits});
            for (const LineRun& run : drawing.runs) CHECK(run.length > 0.0);
            for (const LineChain& chain : drawing.chains)
                CHECK(chain.kind != LineKind::intersection);
            REQUIRE(drawing.chains.size() >= 2);
        }
}

}  // namespace
}  // namespace rimline
