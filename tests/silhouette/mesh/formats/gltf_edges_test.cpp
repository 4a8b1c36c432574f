#include "silhouette/mesh/formats/gltf_edges.h"

#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

using Codes = std::vector<std::uint8_t>;

std::uint8_t codes(unsigned first, unsigned second, unsigned third) {
    return std::uint8_t(first | second << 2 | third << 4);
}

// The square of the specification's examples as two triangles, 0 1 2 and 0 2 3, and what the extension needs:
// accessor 0 has positions, 1 indices, 2 `visibility`, 3 normals, bytes and as many as are given, 4 `lines` as
// bytes.
struct Square {
    std::string visibility = std::string("\x12\x02");
    std::uint32_t normals = 2;
    std::string lines = {};
    std::string extension = R"("visibility": 2, "silhouetteNormals": 3)";
    std::string mode = "4";
    std::string node = R"({"mesh": 0})";
    std::string more = {};
    std::string visibility_type = R"("componentType": 5121, "type": "SCALAR")";
    std::string normals_type = R"("componentType": 5120, "type": "VEC3", "normalized": true)";
    std::string corners = std::string("\0\1\2\0\2\3", 6);

    std::string file() const {
        Bytes bytes;
        for (const glm::vec3 p :
             {glm::vec3(0, 1, 0), glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0.5f)})
            bytes.add(p.x).add(p.y).add(p.z);
        const auto view = [](std::size_t offset, std::size_t size) {
            return R"({"buffer": 0, "byteOffset": )" + std::to_string(offset) +
                   R"(, "byteLength": )" + std::to_string(size) + "}";
        };
        std::string views = view(0, 48);
        std::string accessors =
            R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"})";
        const auto add = [&](const std::string& content, std::size_t count,
                             const std::string& type) {
            accessors += R"(, {"bufferView": )" +
                         std::to_string(std::count(views.begin(), views.end(), '{')) +
                         R"(, "count": )" + std::to_string(count) + ", " + type + "}";
            views += ", " + view(bytes.str().size(), content.size());
            bytes.add_text(content);
        };
        const std::string scalars = R"("componentType": 5121, "type": "SCALAR")";
        add(corners, corners.size(), scalars);
        add(visibility, visibility.size(), visibility_type);
        add(std::string(std::size_t{12} * normals + 1, '\1'), normals, normals_type);
        add(lines + '\0', lines.size(), scalars);
        return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": )" +
               std::to_string(bytes.str().size()) +
               R"(, "uri": "data:application/octet-stream;base64,)" + base64(bytes.str()) +
               R"("}], "bufferViews": [)" + views + R"(], "accessors": [)" + accessors +
               R"(], "nodes": [)" + node +
               R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0},
"indices": 1, "mode": )" +
               mode + R"(, "extensions": {"EXT_mesh_primitive_edge_visibility": {)" + extension +
               "}}}" + more + "]}]}";
    }
    Codes read() const { return read_text("a.gltf", file()).edge_codes; }
    std::string error() const { return error_of("a.gltf", file()); }
};

constexpr const char* k_place =
    "a.gltf: meshes[0].primitives[0]: EXT_mesh_primitive_edge_visibility";

bool fails_with(const Square& square, const std::string& what) { return has(square.error(), what); }

}  // namespace

TEST_CASE("glTF edges: the examples of the specification") {
    CHECK(Square{}.read() == Codes{codes(2, 0, 1), codes(0, 2, 0)});
    CHECK(
        Square{.visibility = "\xe2\x02", .normals = 0, .extension = R"("visibility": 2)"}.read() ==
        Codes{codes(2, 0, 2), codes(3, 2, 0)});
}

TEST_CASE("glTF edges: strips, fans, mirrors, instances, and primitives without the extension") {
    // Of a strip of two triangles, the second is 1 3 2.
    CHECK(Square{.visibility = "\x39\x0f", .mode = "5", .corners = std::string("\0\1\2\3", 4)}
              .read() == Codes{codes(1, 2, 3), codes(0, 3, 3)});
    CHECK(Square{.visibility = "\x39\x0f", .mode = "6", .corners = std::string("\0\1\2\3", 4)}
              .read() == Codes{codes(1, 2, 3), codes(0, 3, 3)});
    CHECK(Square{.node = R"({"mesh": 0}, {"mesh": 0, "scale": [-1, 1, 1]})"}.read() ==
          Codes{codes(2, 0, 1), codes(0, 2, 0), codes(1, 0, 2), codes(0, 2, 0)});
    CHECK(Square{.more = R"(, {"attributes": {"POSITION": 0}, "indices": 1})"}.read() ==
          Codes{codes(2, 0, 1), codes(0, 2, 0), 0, 0});
    CHECK(read_text("a.gltf", sample_gltf_embedded()).edge_codes.empty());
    CHECK(mirrored_edge_codes(codes(1, 2, 3)) == codes(3, 2, 1));
}

TEST_CASE("glTF edges: line strings are hard edges") {
    const std::string extension = R"("lineStrings": [{"indices": 4}])";
    const auto read = [&](const std::string& lines) {
        return Square{.lines = lines, .extension = extension}.read();
    };
    CHECK(read(std::string("\1\0\2", 3)) == Codes{codes(2, 0, 2), codes(3, 0, 0)});
    CHECK(read("\1\2\xff\3\2") == Codes{codes(0, 2, 0), codes(0, 2, 0)});
    CHECK(Square{.lines = "\3\2",
                 .extension = R"("visibility": 2, "silhouetteNormals": 3, )" + extension}
              .read() == Codes{codes(2, 0, 1), codes(0, 2, 0)});
    const auto fails = [&](const std::string& lines, const std::string& what) {
        return fails_with({.lines = lines, .extension = extension},
                          k_place + std::string(".lineStrings") + what);
    };
    CHECK(fails("\1\3", ": the line from vertex 1 to 3 is no edge of a triangle"));
    CHECK(fails("\1\4", "[0]: index 4 (number 1) is out of range; there are 4 vertices"));
    CHECK(fails("\1", "[0]: the strip that ends at index number 1 has 1 vertices"));
    CHECK(fails("", "[0]: the strip that ends at index number 0 has 0 vertices"));
    CHECK(fails("\xff\1\2", "[0]: the strip that ends at index number 0 has 0 vertices"));
    CHECK(fails("\1\2\xff\xff\1\2", "[0]: the strip that ends at index number 3 has 0 vertices"));
    CHECK(fails("\1\2\xff", "[0]: the strip that ends at index number 3 has 0 vertices"));
    std::string many;
    for (int i = 0; i < 10; ++i) many += "\1\2";
    CHECK(fails(many, "[0]: there are more indices than edges of triangles need"));
}

TEST_CASE("glTF edges: faults are errors with their place") {
    const std::string place = k_place;
    CHECK(fails_with({.visibility = "\x12"},
                     place + ".visibility: 1 bytes for 2 triangles; they need 2"));
    CHECK(
        fails_with({.visibility = "\x12\x02\x01"}, place + ".visibility: 3 bytes for 2 triangles"));
    CHECK(fails_with({.visibility = "\x12\x12"},
                     place + ".visibility: bits after those of the last triangle"));
    CHECK(
        fails_with({.extension = R"("visibility": 2)"},
                   place + ".visibility: 1 silhouette edges, but there are no silhouetteNormals"));
    CHECK(
        fails_with({.normals = 1}, place + ".silhouetteNormals: 1 normals for 1 silhouette edges"));
    CHECK(fails_with({.visibility = "\xe2\x02"},
                     place + ".silhouetteNormals: 2 normals for 0 silhouette edges"));
    CHECK(fails_with({.visibility_type = R"("componentType": 5123, "type": "SCALAR")"},
                     "accessors[2]: should be of type SCALAR and of bytes"));
    CHECK(fails_with({.visibility_type = R"("componentType": 5121, "type": "VEC2")"},
                     "accessors[2]: should be of type SCALAR and of bytes"));
    CHECK(fails_with({.normals_type = R"("componentType": 5123, "type": "VEC3")"},
                     "accessors[3]: should be of type VEC3 and of floats or signed integers"));
    CHECK(fails_with({.normals_type = R"("componentType": 5126, "type": "VEC4")"},
                     "accessors[3]: should be of type VEC3"));
    CHECK(fails_with({.extension = R"("visibility": 9)"}, "accessors[9]: does not exist"));
    CHECK(fails_with({.mode = "1"}, place + ": the primitive has no triangles"));
    const std::string path =
        "meshes[0].primitives[0].extensions.EXT_mesh_primitive_edge_visibility";
    CHECK(fails_with({.extension = ""}, path + ": has neither 'visibility' nor 'lineStrings'"));
    CHECK(fails_with({.extension = R"("lineStrings": [])"}, path + ": has neither"));
    CHECK(fails_with({.extension = R"("visibility": "2")"},
                     path + ".visibility: should be an integer"));
    CHECK(fails_with({.extension = R"("lineStrings": [{}])"},
                     path + ".lineStrings[0]: has no 'indices'"));
}

TEST_CASE("glTF edges: a file may require the extension") {
    const std::string begin = R"({"asset")";
    const std::string file =
        R"({"extensionsRequired": ["EXT_mesh_primitive_edge_visibility"], "asset")" +
        Square{}.file().substr(begin.size());
    CHECK(read_text("a.gltf", file).edge_codes.size() == 2);
}
