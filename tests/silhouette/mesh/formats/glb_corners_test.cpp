#include "silhouette/mesh/formats/glb_corners.h"

#include <functional>

#include "silhouette/mesh/formats/glb_writer.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/srgb.h"
#include "tests/silhouette/mesh/formats/read_colors.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

using ColorOf =
    std::function<glm::vec3(std::size_t face, std::size_t corner, std::uint32_t vertex)>;

/// A ball with one material, whose corners have these colors.
MeshSource colored_ball(const ColorOf& color) {
    MeshSource source = make_built_in_shape("sphere", 500);
    FaceMaterials& materials = source.materials;
    materials.materials = {{.base_color = glm::vec3(0.5f, 1, 0.25f)}};
    materials.of_face.assign(source.triangles.size(), MaterialId{0});
    for (std::size_t f = 0; f < source.triangles.size(); ++f)
        for (std::size_t c = 0; c < 3; ++c)
            materials.corner_colors.push_back(color(f, c, source.triangles[f][c]));
    return source;
}

glm::vec3 color_of_number(std::size_t number) {
    return linear_from_srgb(glm::vec3(number % 7, number % 11, number % 13) / 13.0f);
}

/// Writes the mesh, reads it again and compares all that has not to do with the order of materials. `order` has the
/// number of each face of the file.
void check_round_trip(const Mesh& mesh, const std::vector<std::uint32_t>& order) {
    const std::vector<EdgeVisibility> edges = edge_visibility(mesh, crease_flags(mesh, 0.5f));
    const MeshSource source = read_text("a.glb", glb_bytes(mesh, {edges}));
    CHECK(source.warnings.empty());
    CHECK(tests::is_sound(source));
    const Mesh read(source);
    CHECK(std::ranges::equal(read.positions(), mesh.positions()));
    REQUIRE(read.face_count() == mesh.face_count());
    const std::vector<EdgeVisibility> read_edges =
        edge_visibility_of_codes(read, source.edge_codes);
    bool are_equal = true;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        are_equal &= read.triangles()[f] == mesh.triangles()[order[f]];
        are_equal &= colors_of(read.materials(), f) == colors_of(mesh.materials(), order[f]);
        for (unsigned c = 0; c < 3; ++c)
            are_equal &= read_edges[index(read.edges_of(FaceId{f})[c])] ==
                         edges[index(mesh.edges_of(FaceId{order[f]})[c])];
    }
    CHECK(are_equal);
}

void check_round_trip(const Mesh& mesh) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) order.push_back(f);
    check_round_trip(mesh, order);
}

}  // namespace

TEST_CASE("GLB: colors of vertices are kept and no vertex is copied") {
    const MeshSource source = colored_ball(
        [](std::size_t, std::size_t, std::uint32_t vertex) { return color_of_number(vertex); });
    const Mesh mesh(source, Welding::none);
    const GlbCorners corners = glb_corners(mesh);
    CHECK(corners.copies.empty());
    CHECK(corners.vertices.empty());
    CHECK(corners.colors.size() == mesh.vertex_count());
    check_round_trip(Mesh(source));
}

TEST_CASE("GLB: colors of faces are kept and a vertex has one copy for each other color") {
    const MeshSource source = colored_ball(
        [](std::size_t face, std::size_t, std::uint32_t) { return color_of_number(face % 2); });
    const Mesh mesh(source);
    const GlbCorners corners = glb_corners(mesh);
    CHECK(corners.copies.size() <= mesh.vertex_count());
    CHECK(corners.copies.size() > mesh.vertex_count() / 2);
    CHECK(corners.colors.size() == mesh.vertex_count() + corners.copies.size());
    check_round_trip(mesh);
}

TEST_CASE("GLB: every corner may have its own color") {
    const MeshSource source = colored_ball([](std::size_t face, std::size_t corner, std::uint32_t) {
        return glm::vec3(float(face), float(corner), 1.0f) / 1000.0f;
    });
    const Mesh mesh(source);
    CHECK(mesh.vertex_count() + glb_corners(mesh).copies.size() == 3 * mesh.face_count());
    check_round_trip(mesh);
}

TEST_CASE("GLB: faces without a material stay without a color beside others with colors") {
    MeshSource source = colored_ball(
        [](std::size_t face, std::size_t, std::uint32_t) { return color_of_number(face); });
    FaceMaterials& materials = source.materials;
    materials.materials.push_back({.base_color = glm::vec3(0.1f, 0.2f, 0.3f)});
    std::vector<std::uint32_t> order;
    for (std::uint32_t group = 0; group < 3; ++group)
        for (std::uint32_t f = group; f < source.triangles.size(); f += 3) order.push_back(f);
    for (std::size_t f = 0; f < source.triangles.size(); ++f) {
        materials.of_face[f] = f % 3 == 2 ? k_no_material : MaterialId(f % 3);
        // All corners of the second material are white: it needs no colors.
        if (f % 3 == 1)
            std::fill_n(materials.corner_colors.begin() + std::ptrdiff_t(3 * f), 3,
                        glm::vec3(1.0f));
    }
    const Mesh mesh(source);
    check_round_trip(mesh, order);
}

TEST_CASE("GLB: the colors of every format are those of the file that is written from it") {
    const std::string points = "0 0 0 255 51 0\n1 0 0 0 255 9\n1 1 0 1 2 3\n0 1 0 255 255 255\n";
    for (const auto& [name, text] :
         {std::pair<std::string, std::string>{
              "a.off", "COFF\n4 2 0\n" + points + "3 0 1 2 200 100 50\n3 0 2 3 0.1 0.2 0.3\n"},
          {"b.off", "COFF\n4 2 0\n" + points + "3 0 1 2\n3 0 2 3\n"},
          {"c.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 200 100 50\n3 0 2 3\n"},
          {"a.obj", "v 0 0 0 1 0.3 0\nv 1 0 0 0.1 1 0.7\nv 1 1 0\nf 1 2 3\nf 1 3 2\n"}}) {
        CAPTURE(name);
        const Mesh mesh(read_text(name, text));
        REQUIRE(!mesh.materials().empty());
        // A face without a color comes last here.
        check_round_trip(mesh);
    }
}

TEST_CASE("GLB: no colors are written for a mesh that has none") {
    const Mesh plain_ball(make_built_in_shape("sphere", 500));
    CHECK(glb_corners(plain_ball).colors.empty());
    CHECK(!has(glb_bytes(plain_ball, {}), "COLOR_0"));
    const MeshSource white =
        colored_ball([](std::size_t, std::size_t, std::uint32_t) { return glm::vec3(1.0f); });
    CHECK(!has(glb_bytes(Mesh(white), {}), "COLOR_0"));
}
