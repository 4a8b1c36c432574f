#include "tools/options/simplified_mesh.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/winding.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

TEST_CASE("a simplified mesh has about so many faces and nearly the same volume") {
    const Mesh mesh(make_built_in_shape("knot", 8000));
    const Mesh simple(simplified(mesh, 2000));
    CHECK(simple.face_count() <= 2000);
    CHECK(simple.face_count() > 1800);
    CHECK(simple.is_closed());
    CHECK(enclosed_volume(simple) == doctest::Approx(enclosed_volume(mesh)).epsilon(0.03));
}

TEST_CASE("so has one of more faces than are collapsed one by one" * doctest::test_suite("plain")) {
    const Mesh mesh(make_built_in_shape("knot", 1'100'000));
    REQUIRE(mesh.face_count() > 1'000'000);
    const Mesh simple(simplified(mesh, 20'000));
    CHECK(simple.face_count() <= 20'000);
    CHECK(simple.face_count() > 18'000);
    CHECK(enclosed_volume(simple) == doctest::Approx(enclosed_volume(mesh)).epsilon(0.01));
}

TEST_CASE("small parts far from each other are left, where a grid would join each to a point") {
    MeshSource source = make_built_in_shape("knot", 1'100'000);
    for (glm::vec3& position : source.positions) position *= 1e-3f;
    const auto first = static_cast<std::uint32_t>(source.positions.size());
    for (const glm::vec3& corner :
         {glm::vec3(1e4f, 0, 0), glm::vec3(1e4f, 1, 0), glm::vec3(1e4f, 0, 1)})
        source.positions.push_back(corner);
    source.triangles.push_back({first, first + 1, first + 2});
    const MeshSource simple = simplified(Mesh(source), 20'000);
    CHECK(simple.triangles.size() <= 20'000);
    CHECK(simple.triangles.size() > 1'000);
    CHECK(simple.positions.size() < 20'000);
}

TEST_CASE("a simplified mesh can be cancelled") {
    std::stop_source stop;
    stop.request_stop();
    const Mesh mesh(make_built_in_shape("torus", 20'000));
    CHECK_THROWS_AS(simplified(mesh, 4'000, {stop.get_token(), {}}), Error);
}

TEST_CASE("a simplified mesh keeps the colors of its faces and corners where they are") {
    MeshSource source = make_built_in_shape("torus", 20'000);
    const auto is_right = [](const glm::vec3& position) { return position.x > 0.0f; };
    source.materials.materials = {{{1, 0, 0}, {}}, {{0, 1, 0}, {}}};
    for (SurfaceMaterial& material : source.materials.materials) material.texture = k_no_texture;
    for (const auto& triangle : source.triangles) {
        source.materials.of_face.push_back(
            MaterialId{is_right(source.positions[triangle[0]]) ? 1u : 0u});
        for (const std::uint32_t vertex : triangle)
            source.materials.corner_colors.push_back(
                glm::vec3(is_right(source.positions[vertex]) ? 0.25f : 0.75f));
    }
    const Mesh mesh(source);
    const MeshSource simple = simplified(mesh, 4'000);
    REQUIRE(are_materials_of(simple.materials, simple.triangles.size()));
    std::size_t other_face = 0, other_corner = 0;
    for (std::size_t f = 0; f < simple.triangles.size(); ++f) {
        const bool right = is_right(simple.positions[simple.triangles[f][0]]);
        other_face += simple.materials.of_face[f] != MaterialId{right ? 1u : 0u};
        for (std::size_t c = 0; c < 3; ++c)
            other_corner += simple.materials.corner_colors[3 * f + c].x !=
                            (is_right(simple.positions[simple.triangles[f][c]]) ? 0.25f : 0.75f);
    }
    CHECK(other_corner == 0);
    CHECK(other_face < 200);  // At the border of both.
    CHECK(Mesh(simple).materials().materials == mesh.materials().materials);
}

}  // namespace
