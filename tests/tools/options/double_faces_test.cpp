#include "tools/options/double_faces.h"

#include <doctest/doctest.h>

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE(
    "of faces back to back the first stays, with its color, and all others stay as they are") {
    MeshSource source;
    // Two triangles of a square, the square again from behind with vertices of its own, and a face beside it.
    source.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0},
                        {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    source.triangles = {{0, 1, 2}, {0, 2, 3}, {6, 5, 4}, {7, 6, 4},
                        {1, 8, 2}, {3, 3, 2}, {3, 3, 2}, {2, 0, 1}};
    source.materials.materials = {{{1, 0, 0}}, {{0, 0, 1}}, {{0, 1, 0}}};
    for (const std::uint32_t m : {0, 0, 1, 1, 2, 2, 2, 1})
        source.materials.of_face.push_back(MaterialId{m});
    for (std::size_t f = 0; f < 8; ++f)
        for (int corner = 0; corner < 3; ++corner)
            source.materials.corner_colors.push_back(glm::vec3(float(f) / 10.0f, float(corner), 0));
    CHECK(remove_double_faces(source) == 3);
    using Face = std::array<std::uint32_t, 3>;
    CHECK(source.triangles ==
          std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {1, 8, 2}, {3, 3, 2}, {3, 3, 2}});
    CHECK(source.materials.of_face == std::vector<MaterialId>{MaterialId{0}, MaterialId{0},
                                                              MaterialId{2}, MaterialId{2},
                                                              MaterialId{2}});
    REQUIRE(source.materials.corner_colors.size() == 15);
    CHECK(source.materials.corner_colors[6] == glm::vec3(0.4f, 0, 0));
    CHECK(source.materials.corner_colors[8] == glm::vec3(0.4f, 2, 0));
    CHECK(are_materials_of(source.materials, source.triangles.size()));
    CHECK(Mesh(source, Welding::equal_positions).edges_of_class(EdgeClass::nonmanifold).first ==
          Mesh(source, Welding::equal_positions).edges_of_class(EdgeClass::nonmanifold).last);
    const MeshSource before = source;
    CHECK(remove_double_faces(source) == 0);
    CHECK(source.triangles == before.triangles);
}
