#include "silhouette/mesh/face_materials.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/mesh_source.h"
#include "silhouette/mesh/shapes/loop_subdivision.h"

namespace rimline {
namespace {

TEST_CASE("materials belong to a mesh whose faces they are") {
    const FaceMaterials none;
    CHECK(none.empty());
    CHECK(are_materials_of(none, 0));
    CHECK(are_materials_of(none, 5));
    const FaceMaterials two{{{}, {}}, {MaterialId{1}, k_no_material}, {}};
    CHECK(are_materials_of(two, 2));
    CHECK_FALSE(are_materials_of(two, 1));
    CHECK_FALSE(are_materials_of(two, 3));
    FaceMaterials changed = two;
    changed.of_face[0] = MaterialId{2};
    CHECK_FALSE(are_materials_of(changed, 2));
    changed = two;
    changed.corner_colors.resize(6);
    CHECK(are_materials_of(changed, 2));
    changed.corner_colors.resize(3);
    CHECK_FALSE(are_materials_of(changed, 2));
    changed.of_face.clear();
    CHECK_FALSE(are_materials_of(changed, 1));
}

// A flat triangle keeps its plane: a color that is linear on it must be the same linear function on its parts.
TEST_CASE("subdivision keeps a color that is linear over a face") {
    MeshSource source{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 0, 1}}};
    source.materials = {{{glm::vec3(0.5f)}},
                        {MaterialId{0}, k_no_material},
                        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
    const FaceMaterials refined = subdivide_loop(source, 1).materials;
    REQUIRE(are_materials_of(refined, 8));
    CHECK(refined.materials == source.materials.materials);
    const glm::vec3 a(1, 0, 0), b(0, 1, 0), c(0, 0, 1);
    const glm::vec3 ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
    const std::vector<glm::vec3> expected{a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca};
    for (std::size_t i = 0; i < 12; ++i) {
        CHECK(refined.corner_colors[i] == expected[i]);
        CHECK(refined.corner_colors[12 + i] == glm::vec3(1.0f));
    }
    for (std::size_t f = 0; f < 4; ++f) {
        CHECK(refined.of_face[f] == MaterialId{0});
        CHECK(refined.of_face[4 + f] == k_no_material);
    }
    CHECK(subdivide_loop(source, 0).materials == source.materials);
}

}  // namespace
}  // namespace rimline
