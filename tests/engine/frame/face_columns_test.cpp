#include "engine/frame/face_columns.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/shadow_scenes.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

// The faces whose boxes across the axis hold a place.
std::uint32_t faces_around(const Mesh& mesh, int axis, const glm::vec3& place) {
    std::uint32_t count = 0;
    for (const Triangle& triangle : mesh.triangles()) {
        bool holds = true;
        for (const int across : {(axis + 1) % 3, (axis + 2) % 3}) {
            const auto [low, high] = std::minmax({mesh.positions()[index(triangle[0])][across],
                                                  mesh.positions()[index(triangle[1])][across],
                                                  mesh.positions()[index(triangle[2])][across]});
            holds = holds && low <= place[across] && place[across] <= high;
        }
        count += holds ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("a column has at least the faces that a line in it meets, and not many more") {
    constexpr std::uint64_t k_seed = 6;
    CAPTURE(k_seed);
    Random random(k_seed);
    std::vector<MeshSource> sources{triangle_soup(200, k_seed),
                                    square(1.0, 0.5),
                                    {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}};
    for (const char* name : {"box", "sphere", "knot", "terrain"})
        sources.push_back(make_built_in_shape(name, 3000));
    for (const MeshSource& source : sources) {
        const Mesh mesh(source);
        const FaceColumns columns(mesh);
        const glm::dvec3 low(mesh.bounds().low);
        const glm::dvec3 extent = glm::dvec3(mesh.bounds().high) - low;
        for (int axis = 0; axis < 3; ++axis) CHECK(extent[columns.axis()] <= extent[axis]);
        double exact = 0.0, counted = 0.0;
        for (int i = 0; i < 300; ++i) {
            glm::vec3 place(low + extent * (0.5 + 0.5 * glm::dvec3(random.in_cube())));
            if (i % 3 == 0) place = mesh.positions()[random.below(mesh.vertex_count())];
            const std::uint32_t around = faces_around(mesh, columns.axis(), place);
            CHECK(columns.faces_on_line(glm::dvec3(place)) >= around);
            CHECK(columns.faces_on_line(glm::dvec3(place)) <= mesh.face_count());
            exact += around;
            counted += columns.faces_on_line(glm::dvec3(place));
        }
        CHECK(counted <= 8.0 * exact + 300.0);
    }
    CHECK(FaceColumns(Mesh(MeshSource{})).faces_on_line({0, 0, 0}) == 0);
}
