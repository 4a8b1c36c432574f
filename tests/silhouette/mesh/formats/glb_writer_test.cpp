#include "silhouette/mesh/formats/glb_writer.h"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/upright.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

std::vector<EdgeVisibility> classes_of(const Mesh& mesh) {
    return edge_visibility(mesh, crease_flags(mesh, float(glm::radians(30.0))));
}

nlohmann::json document_of(const std::string& glb) {
    std::uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, 4);
    return nlohmann::json::parse(glb.substr(20, size));
}

// A ball whose faces have one of three materials or none, in turn.
MeshSource painted_sphere() {
    MeshSource source = make_built_in_shape("sphere", 500);
    for (const float red : {0.25f, 0.5f, 0.75f})
        source.materials.materials.push_back({glm::vec3(red, 0.125f, 1.0f)});
    for (std::size_t f = 0; f < source.triangles.size(); ++f)
        source.materials.of_face.push_back(f % 4 == 3 ? k_no_material : MaterialId(f % 4));
    return source;
}

}  // namespace

TEST_CASE("GLB: what is written is read again, faces in their order and every edge in its class") {
    for (const std::string_view shape : k_built_in_shapes)
        for (const SilhouetteNormals normals :
             {SilhouetteNormals::bytes, SilhouetteNormals::floats}) {
            CAPTURE(shape);
            const Mesh mesh(make_built_in_shape(shape, 1000));
            const std::vector<EdgeVisibility> edges = classes_of(mesh);
            const MeshSource source = read_text("a.glb", glb_bytes(mesh, {edges, normals}));
            const Mesh read(source);
            REQUIRE(std::ranges::equal(read.positions(), mesh.positions()));
            REQUIRE(std::ranges::equal(read.triangles(), mesh.triangles()));
            // The same faces, so edges have the same numbers.
            CHECK(edge_visibility_of_codes(read, source.edge_codes) == edges);
            const EdgeVisibilityCounts counts = count_classes(edges);
            if (shape == "terrain" || shape == "scene") CHECK(counts.silhouette > 100);
            if (shape == "box") CHECK(counts.hidden > 100);
        }
}

TEST_CASE("GLB: more vertices than 16 bits number") {
    const Mesh mesh(make_built_in_shape("torus", 140'000));
    REQUIRE(mesh.vertex_count() > 0xffff);
    const std::vector<EdgeVisibility> edges = classes_of(mesh);
    const MeshSource source = read_text("a.glb", glb_bytes(mesh, {edges}));
    const Mesh read(source);
    CHECK(std::ranges::equal(read.triangles(), mesh.triangles()));
    CHECK(edge_visibility_of_codes(read, source.edge_codes) == edges);
}

TEST_CASE("GLB: a primitive for each material, and each edge has its class once") {
    const MeshSource painted = painted_sphere();
    const Mesh mesh(painted);
    const std::vector<EdgeVisibility> edges = classes_of(mesh);
    const std::string glb = glb_bytes(mesh, {edges});
    CHECK(document_of(glb)["meshes"][0]["primitives"].size() == 4);
    const MeshSource source = read_text("a.glb", glb);
    const Mesh read(source);
    REQUIRE(read.face_count() == mesh.face_count());
    std::uint32_t silhouettes = 0;
    std::vector<std::uint32_t> order;  // Of the faces in the file.
    for (std::uint32_t group = 0; group < 4; ++group)
        for (std::uint32_t f = group; f < mesh.face_count(); f += 4) order.push_back(f);
    const std::vector<EdgeVisibility> read_edges =
        edge_visibility_of_codes(read, source.edge_codes);
    bool are_equal = true;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const FaceId old{order[f]};
        are_equal &= read.triangles()[f] == mesh.triangles()[index(old)];
        const MaterialId material = painted.materials.of_face[index(old)];
        const MaterialId read_material = source.materials.of_face[f];
        are_equal &= (material == k_no_material) == (read_material == k_no_material);
        if (material != k_no_material && read_material != k_no_material)
            are_equal &= painted.materials.materials[index(material)].base_color ==
                         source.materials.materials[index(read_material)].base_color;
        for (unsigned c = 0; c < 3; ++c) {
            are_equal &= edges[index(mesh.edges_of(old)[c])] ==
                         read_edges[index(read.edges_of(FaceId{f})[c])];
            silhouettes += (source.edge_codes[f] >> (2 * c) & 3) == 1;
        }
    }
    CHECK(are_equal);
    CHECK(silhouettes == count_classes(edges).silhouette);
}

TEST_CASE("GLB: without classes, and where all edges are hidden, there is no extension") {
    const Mesh mesh(make_built_in_shape("sphere", 100));
    for (const std::vector<EdgeVisibility>& edges :
         {std::vector<EdgeVisibility>(), std::vector<EdgeVisibility>(mesh.edge_count())}) {
        const std::string glb = glb_bytes(mesh, {edges});
        CHECK(!document_of(glb).contains("extensionsUsed"));
        CHECK(read_text("a.glb", glb).edge_codes.empty());
    }
}

TEST_CASE("GLB: a mesh that stands along any axis is turned to stand on y") {
    const Mesh mesh(make_built_in_shape("knot", 500));
    const auto volume = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return glm::dot(a, glm::cross(b, c));
    };
    for (const glm::dvec3& up : k_axis_directions) {
        CAPTURE(up.x);
        CAPTURE(up.y);
        CAPTURE(up.z);
        const MeshSource read = read_text("a.glb", glb_bytes(mesh, {.up = up}));
        CHECK(read.up == UpAxis::y);
        REQUIRE(read.positions.size() == mesh.vertex_count());
        bool are_turned = true, are_mirrored = false;
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            const glm::dvec3 p(mesh.positions()[v]), q(read.positions[v]);
            are_turned &=
                q.y == glm::dot(p, up) && glm::dot(p, p) == doctest::Approx(glm::dot(q, q));
            if (v < 2) continue;
            const double before =
                volume(p, glm::dvec3(mesh.positions()[v - 1]), glm::dvec3(mesh.positions()[v - 2]));
            const double after =
                volume(q, glm::dvec3(read.positions[v - 1]), glm::dvec3(read.positions[v - 2]));
            are_mirrored |= std::abs(after - before) > 1e-9;
        }
        CHECK(are_turned);
        CHECK(!are_mirrored);
        if (up == glm::dvec3(0, 0, 1))
            CHECK(read.positions[7] ==
                  glm::vec3(mesh.positions()[7].x, mesh.positions()[7].z, -mesh.positions()[7].y));
    }
}

TEST_CASE("GLB: the normals of an edge are those of its faces, and never zero") {
    MeshSource source;
    source.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 1}, {0, 2, 0}};
    const auto normals = [&](std::vector<std::array<std::uint32_t, 3>> triangles,
                             std::uint32_t first) {
        source.triangles = std::move(triangles);
        const Mesh mesh(source);
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
            const auto [a, b] = mesh.edge(EdgeId{e}).vertices;
            if (std::max(mesh.file_vertex(a), mesh.file_vertex(b)) == 1)
                return silhouette_normals(mesh, EdgeId{e}, FaceId{first});
        }
        FAIL("no such edge");
        return std::array<glm::vec3, 2>{};
    };
    const glm::vec3 up(0, 0, 1);
    const auto near = [](glm::vec3 a, glm::vec3 b) { return glm::distance(a, b) < 1e-6f; };
    const glm::vec3 slope = glm::normalize(glm::vec3(-1, 0, 1));
    for (const std::array<std::uint32_t, 3> second :
         {std::array{1u, 0u, 3u}, std::array{0u, 1u, 3u}}) {
        const auto [a, b] = normals({{0, 1, 2}, second}, 0);
        CHECK(near(a, up));
        CHECK(near(b, slope));  // Also if the second face is turned.
    }
    const auto [b, a] = normals({{0, 1, 2}, {1, 0, 3}}, 1);
    CHECK(near(a, up));
    CHECK(near(b, slope));
    for (const auto& triangles : {std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}},
                                  {{0, 1, 2}, {1, 0, 4}},
                                  {{0, 1, 4}}}) {
        const auto [c, d] = normals(triangles, 0);
        CHECK(near(c, up));
        CHECK(near(d, -up));
    }
}

TEST_CASE("GLB: normals as bytes are the nearest ones") {
    CHECK(normal_bytes({0, 0, -1}) == std::array<std::int8_t, 3>{0, 0, -127});
    CHECK(normal_bytes({0.6f, -0.8f, 0}) == std::array<std::int8_t, 3>{76, -102, 0});
}
