#include "tools/options/placed_model.h"

#include <doctest/doctest.h>
#include <CLI/App.hpp>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline::tools {
namespace {

MeshSource triangle() {
    MeshSource source;
    source.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    source.triangles = {{0, 1, 2}};
    return source;
}

TEST_CASE("the rotation between axes is exact, and between any two directions a rotation") {
    const std::array<glm::dvec3, 6> axes{
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    for (const glm::dvec3& from : axes)
        for (const glm::dvec3& to : axes) {
            const glm::dmat3 rotation = rotation_between(from, to);
            CHECK(rotation * from == to);
            CHECK(glm::determinant(rotation) == 1.0);
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r)
                    CHECK(std::abs(rotation[c][r]) == std::round(std::abs(rotation[c][r])));
        }
    const glm::dvec3 from(3, -1, 2), to(-1, 0.3, 0.2);
    const glm::dmat3 rotation = rotation_between(from, to);
    CHECK(glm::distance(rotation * glm::normalize(from), glm::normalize(to)) < 1e-14);
    CHECK(glm::determinant(rotation) == doctest::Approx(1.0));
    CHECK(glm::dot(rotation[0], rotation[1]) == doctest::Approx(0.0));
}

TEST_CASE("turns are read and written") {
    CHECK(parse_turn("--turn", "30") == Turn{{}, 30.0});
    CHECK(parse_turn("--turn", "z,-90") == Turn{glm::vec3(0, 0, 1), -90.0});
    CHECK(parse_turn("--turn", "1,2,3,45.5") == Turn{glm::vec3(1, 2, 3), 45.5});
    for (const char* text : {"30", "0,0,1,-90", "1,2.5,3,45.5"})
        CHECK(text_of(parse_turn("--turn", text)) == text);
    for (const char* text : {"", "x", "x,", "1,2,30", "auto,30", "0,0,0,30", "361", "nan", "30 "})
        CHECK_THROWS_AS(parse_turn("--turn", text), CLI::ValidationError);
    for (const char* text : {"", "0", "-1", "1e7", "inf", "2x"})
        CHECK_THROWS_AS(parse_scale("--scale", text), CLI::ValidationError);
}

TEST_CASE("sources are joined in order, each at its place") {
    const MeshSource source = triangle();
    const MeshSource all = join_sources(std::array<PlacedSource, 2>{
        {{.source = &source}, {.source = &source, .matrix = glm::dmat3(2.0), .at = {0, 0, 5}}}});
    REQUIRE(all.positions.size() == 6);
    CHECK(all.positions[1] == glm::vec3(1, 0, 0));
    CHECK(all.positions[4] == glm::vec3(2, 0, 5));
    CHECK(all.triangles[1] == std::array<std::uint32_t, 3>{3, 4, 5});
    CHECK(all.materials.empty());
}

TEST_CASE("a source that occurs twice has its materials once, and paint replaces them") {
    MeshSource red = triangle(), plain = triangle();
    red.materials.materials = {{.base_color = {1, 0, 0}}, {.base_color = {0.5f, 0, 0}}};
    red.materials.of_face = {MaterialId{1}};
    red.materials.corner_colors.assign(3, glm::vec3(0.25f));
    const glm::vec3 blue(0, 0, 1);
    const MeshSource all =
        join_sources(std::array<PlacedSource, 5>{{{.source = &plain},
                                                  {.source = &red},
                                                  {.source = &red, .paint = blue},
                                                  {.source = &red},
                                                  {.source = &plain}}});
    const FaceMaterials& joined = all.materials;
    REQUIRE(are_materials_of(joined, all.triangles.size()));
    CHECK(joined.of_face[0] == k_no_material);
    CHECK(joined.of_face[4] == k_no_material);
    CHECK(joined.of_face[1] == joined.of_face[3]);
    CHECK(joined.materials.size() == 3);
    CHECK(joined.materials[index(joined.of_face[1])].base_color == glm::vec3(0.5f, 0, 0));
    CHECK(joined.materials[index(joined.of_face[2])].base_color == blue);
    CHECK(joined.corner_colors[3] == glm::vec3(0.25f));
    // Paint is not multiplied by colors of corners.
    CHECK(joined.corner_colors[6] == glm::vec3(1.0f));
    CHECK(joined.corner_colors[14] == glm::vec3(1.0f));
}

TEST_CASE("textures of joined sources keep their materials") {
    MeshSource a = triangle(), b = triangle();
    for (MeshSource* source : {&a, &b}) {
        source->materials.materials = {{.base_color = glm::vec3(1.0f), .texture = TextureId{0}}};
        source->materials.of_face = {MaterialId{0}};
        source->materials.corner_uvs.assign(3, glm::vec2(0.5f));
    }
    a.materials.textures = {{.place = "a"}};
    b.materials.textures = {{.place = "b"}};
    const MeshSource all =
        join_sources(std::array<PlacedSource, 2>{{{.source = &a}, {.source = &b}}});
    REQUIRE(are_materials_of(all.materials, 2));
    CHECK(all.materials.textures[index(all.materials.texture_of(0))].place == "a");
    CHECK(all.materials.textures[index(all.materials.texture_of(1))].place == "b");
}

TEST_CASE("a model that would leave the range of coordinates is an error that names it") {
    const MeshSource source = triangle();
    const std::array<PlacedSource, 1> far{
        {{.source = &source, .matrix = glm::dmat3(1e6), .at = {1.15e18, 0, 0}, .name = "a.obj"}}};
    CHECK_NOTHROW(join_sources(far));
    const std::array<PlacedSource, 1> outside{
        {{.source = &source, .matrix = glm::dmat3(1e17), .at = {1.15e18, 0, 0}, .name = "a.obj"}}};
    try {
        join_sources(outside);
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(std::string(error.what()).starts_with("a.obj: "));
        CHECK(error.code() == ErrorCode::too_large);
    }
}

TEST_CASE("a model that loses its shape far from the origin is a warning") {
    const MeshSource source = triangle();
    const auto warnings = [&](double at) {
        const std::array<PlacedSource, 1> placed{
            {{.source = &source, .at = {at, 0, 0}, .name = "a.obj"}}};
        return join_sources(placed).warnings.size();
    };
    CHECK(warnings(10000.0) == 0);
    CHECK(warnings(1e6) == 1);
}

TEST_CASE("two boxes that touch become one mesh in which they hide each other") {
    const MeshSource box = make_built_in_shape("box", 0);
    const Mesh apart(join_sources(
        std::array<PlacedSource, 2>{{{.source = &box}, {.source = &box, .at = {3, 0, 0}}}}));
    CHECK(apart.component_count() == 2);
    CHECK(apart.is_closed());
    const Mesh touching(join_sources(
        std::array<PlacedSource, 2>{{{.source = &box}, {.source = &box, .at = {2, 0, 0}}}}));
    CHECK(touching.vertex_count() == 12);
    CHECK(touching.is_closed());
}

}  // namespace
}  // namespace rimline::tools
