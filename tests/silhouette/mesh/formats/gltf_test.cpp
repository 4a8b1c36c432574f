#include <algorithm>
#include <chrono>
#include <cmath>

#include "silhouette/mesh/formats/gltf_buffers.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

// A document around one buffer, given as bytes.
std::string document(const std::string& parts, const std::string& buffer) {
    return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": )" +
           std::to_string(buffer.size()) + R"(, "uri": "data:application/octet-stream;base64,)" +
           base64(buffer) + "\"}]" + (parts.empty() ? "" : ", " + parts) + "}";
}

// Four corners of the unit square in the plane z = 0, as floats, and indices 0 1 2 3 as bytes.
std::string square_buffer() {
    Bytes bytes;
    for (const glm::vec3 p :
         {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(1, 1, 0)})
        bytes.add(p.x).add(p.y).add(p.z);
    for (const int i : {0, 1, 2, 3}) bytes.add(static_cast<std::uint8_t>(i));
    return bytes.str();
}

const std::string k_square_accessors =
    R"("bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 4}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
{"bufferView": 1, "componentType": 5121, "count": 4, "type": "SCALAR"},
{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}])";

std::string square(const std::string& parts) {
    return document(k_square_accessors + ", " + parts, square_buffer());
}

// One triangle mesh under the given nodes and scenes.
std::string with_nodes(const std::string& nodes) {
    return square(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 2}}]}], )" + nodes);
}

std::string primitive(const std::string& properties) {
    return square(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, )" + properties +
                  "}]}]");
}

std::string accessor_mesh(const std::string& views, const std::string& position,
                          const std::string& buffer) {
    return document(
        R"("bufferViews": [)" + views + R"(], "accessors": [)" + position +
            R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}])",
        buffer);
}

// With KHR_mesh_quantization in this list of extensions.
std::string with_extension(const std::string& document, const std::string& list) {
    return "{\"" + list + R"(": ["KHR_mesh_quantization"], )" + document.substr(1);
}

std::vector<glm::vec3> points_of(const std::string& bytes) {
    return read_text("a.gltf", bytes, FaceRequirement::faces_or_points).positions;
}

std::string error(const std::string& bytes) { return error_of("a.gltf", bytes); }

}  // namespace

TEST_CASE("glTF: embedded, beside the file and in a GLB, the same model") {
    const ScratchFolder folder;
    std::filesystem::create_directories(folder.path() / "parts");
    folder.write("parts/some data.bin", sample_gltf_buffer() + "padding");
    for (const std::filesystem::path& path :
         {folder.write("a.gltf", sample_gltf_embedded()), folder.write("a.glb", sample_glb()),
          folder.write("b.gltf",
                       sample_gltf(R"({"byteLength": 186, "uri": "parts/some%20data.bin"})"))}) {
        const MeshSource source = read_mesh_file(path);
        CHECK(source.positions == sample_positions());
        CHECK(source.triangles == sample_triangles());
        CHECK(source.up == UpAxis::y);
        // A program that writes files must not replace those that the model refers to.
        const bool has_part = path.filename() == "b.gltf";
        CHECK(source.files == (has_part ? std::vector{folder.path() / "parts/some data.bin"}
                                        : std::vector<std::filesystem::path>{}));
    }
}

TEST_CASE("glTF: strips, fans, lists with and without indices") {
    const auto triangles = [](const std::string& properties) {
        return read_text("a.gltf", primitive(properties)).triangles;
    };
    CHECK(triangles(R"("mode": 5)") == Triangles{{0, 1, 2}, {1, 3, 2}});
    CHECK(triangles(R"("mode": 6)") == Triangles{{1, 2, 0}, {2, 3, 0}});
    CHECK(triangles(R"("mode": 5, "indices": 1)") == Triangles{{0, 1, 2}, {1, 3, 2}});
    CHECK(read_text("a.gltf", with_nodes(R"("nodes": [{"mesh": 0}])")).triangles ==
          Triangles{{0, 1, 2}});
    for (const char* mode : {"0", "1", "2", "3"})
        CHECK(points_of(primitive(R"("mode": )" + std::string(mode))).size() == 4);
    CHECK(has(error(primitive(R"("mode": 4)")), "meshes[0].primitives[0]: 4 corners do not make"));
    CHECK(has(error(primitive(R"("mode": 7)")), "meshes[0].primitives[0]: mode 7"));
}

TEST_CASE("glTF: node transforms compose, in double, in scene order") {
    // A quarter turn about z, moved and scaled, below a parent given by a matrix.
    const MeshSource source = read_text(
        "a.gltf", with_nodes(R"("scene": 1, "scenes": [{"nodes": [2]}, {"nodes": [0]}], "nodes": [
{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,20,30,1], "children": [1, 2]},
{"translation": [1, 0, 0], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476],
 "scale": [2, 3, 4], "mesh": 0}, {"mesh": 0}])"));
    REQUIRE(source.positions.size() == 6);
    const std::vector<glm::vec3> expected{{11, 20, 30}, {11, 22, 30}, {8, 20, 30},
                                          {10, 20, 30}, {11, 20, 30}, {10, 21, 30}};
    for (std::size_t i = 0; i < 6; ++i)
        for (int axis = 0; axis < 3; ++axis)
            CHECK(source.positions[i][axis] == doctest::Approx(expected[i][axis]).epsilon(1e-6));
    CHECK(source.triangles == Triangles{{0, 1, 2}, {3, 4, 5}});
}

TEST_CASE("glTF: a transform that mirrors turns the triangles round") {
    for (const char* node : {R"({"scale": [-1, 1, 1], "mesh": 0})",
                             R"({"matrix": [0,1,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1], "mesh": 0})"})
        CHECK(
            read_text("a.gltf", with_nodes(R"("nodes": [)" + std::string(node) + "]")).triangles ==
            Triangles{{0, 2, 1}});
    CHECK(read_text("a.gltf", with_nodes(R"("nodes": [{"scale": [-1, -1, 1], "mesh": 0}])"))
              .triangles == Triangles{{0, 1, 2}});
}

TEST_CASE("glTF: without a scene every root is taken, without nodes every mesh") {
    CHECK(
        points_of(with_nodes(R"("nodes": [{"mesh": 0}, {"children": [0]}, {"mesh": 0}])")).size() ==
        6);
    CHECK(points_of(
              with_nodes(R"("scenes": [{"nodes": [2]}], "nodes": [{"mesh": 0}, {"children": [0]},
{"mesh": 0}])"))
              .size() == 3);
    CHECK(points_of(square(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 2}}]},
{"primitives": [{"attributes": {"POSITION": 0}, "mode": 5}]}])"))
              .size() == 7);
}

TEST_CASE("glTF: node graphs with cycles, shared or missing nodes are refused") {
    CHECK(has(error(with_nodes(R"("nodes": [{"children": [1]}, {"children": [0], "mesh": 0}])")),
              "nodes: every node is another's child"));
    CHECK(has(error(with_nodes(R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [1]},
{"children": [0], "mesh": 0}])")),
              "nodes[0]: is reached twice"));
    CHECK(has(error(with_nodes(R"("nodes": [{"children": [2]}, {"children": [2]}, {"mesh": 0}])")),
              "nodes[2]: is reached twice"));
    CHECK(
        has(error(with_nodes(R"("nodes": [{"children": [7]}])")), "nodes: node 7 does not exist"));
    CHECK(has(error(with_nodes(R"("nodes": [{"mesh": 7}])")),
              "nodes[0].mesh: mesh 7 does not exist"));
    CHECK(
        has(error(with_nodes(R"("scene": 3, "nodes": [{"mesh": 0}])")), "scene 3 does not exist"));
    std::string chain = R"("nodes": [{"mesh": 0})";
    for (int i = 0; i < 20000; ++i) chain += R"(,{"children": [)" + std::to_string(i) + "]}";
    CHECK(points_of(with_nodes(chain + "]")).size() == 3);
}

TEST_CASE("glTF: positions of every component type, normalized or not, strided and offset") {
    Bytes bytes;
    bytes.add<std::uint32_t>(0xffffffffu);
    for (int i = 0; i < 2; ++i)
        bytes.add<std::int8_t>(-128).add<std::int8_t>(127).add<std::int8_t>(0).add<std::int8_t>(99);
    const std::string view = R"({"buffer": 0, "byteOffset": 2, "byteLength": 10, "byteStride": 4})";
    const auto of = [&](const std::string& type, const std::string& more) {
        return with_extension(
            accessor_mesh(view, R"({"bufferView": 0, "byteOffset": 2, "count": 2, "type": "VEC3",
"componentType": )" + type + more + "}",
                          bytes.str()),
            "extensionsUsed");
    };
    CHECK(points_of(of("5120", ""))[1] == glm::vec3(-128, 127, 0));
    CHECK(points_of(of("5120", R"(, "normalized": true)"))[1] == glm::vec3(-1, 1, 0));
    CHECK(points_of(of("5121", ""))[0] == glm::vec3(128, 127, 0));
    CHECK(points_of(of("5121", R"(, "normalized": true)"))[1] ==
          glm::vec3(float(128 / 255.0), float(127 / 255.0), 0));
    CHECK(has(error(of("5122", "")), "accessors[0]: byteStride is less than an element's 6 bytes"));

    Bytes shorts;
    shorts.add<std::int16_t>(-32768).add<std::int16_t>(32767).add<std::int16_t>(-1);
    const auto of_shorts = [&](const std::string& type, const std::string& more) {
        return with_extension(
            accessor_mesh(R"({"buffer": 0, "byteLength": 6})",
                          R"({"bufferView": 0, "count": 1, "type": "VEC3", "componentType": )" +
                              type + more + "}",
                          shorts.str()),
            "extensionsRequired");
    };
    CHECK(points_of(of_shorts("5122", ""))[0] == glm::vec3(-32768, 32767, -1));
    CHECK(points_of(of_shorts("5122", R"(, "normalized": true)"))[0] ==
          glm::vec3(-1, 1, float(-1 / 32767.0)));
    CHECK(points_of(of_shorts("5123", ""))[0] == glm::vec3(32768, 32767, 65535));
    CHECK(points_of(of_shorts("5123", R"(, "normalized": true)"))[0].z == 1.0f);
    Bytes ints;
    ints.add<std::uint32_t>(7).add<std::uint32_t>(4000000000u).add<std::uint32_t>(0);
    const std::string unsigned_ints = accessor_mesh(
        R"({"buffer": 0, "byteLength": 12})",
        R"({"bufferView": 0, "count": 1, "type": "VEC3", "componentType": 5125})", ints.str());
    for (const std::string& document :
         {unsigned_ints, with_extension(unsigned_ints, "extensionsUsed")})
        CHECK(has(error(document), "accessors[0]: componentType 5125: positions are floats, or"));
    // Integers need the extension.
    for (const char* type : {"5122", "5123"})
        for (const char* more : {"", R"(, "normalized": true)"}) {
            const std::string document = of_shorts(type, more);
            const auto at = document.find(R"("extensionsRequired")");
            CHECK(has(error(document.substr(0, at) + R"("asset2")" +
                            document.substr(at + std::string(R"("extensionsRequired")").size())),
                      "accessors[0]: componentType " + std::string(type)));
        }
}

TEST_CASE("glTF: sparse accessors replace elements, of a view or of zeros and indices too") {
    Bytes bytes;
    for (int i = 0; i < 9; ++i) bytes.add(static_cast<float>(i));
    bytes.add<std::uint16_t>(0).add<std::uint16_t>(2);
    for (int i = 10; i < 16; ++i) bytes.add(static_cast<float>(i));
    const std::string views = R"({"buffer": 0, "byteLength": 36},
{"buffer": 0, "byteOffset": 36, "byteLength": 4}, {"buffer": 0, "byteOffset": 40, "byteLength": 24})";
    const std::string sparse = R"("sparse": {"count": 2, "indices": {"bufferView": 1,
"componentType": 5123}, "values": {"bufferView": 2}}})";
    const std::string head = R"({"componentType": 5126, "count": 3, "type": "VEC3", )";
    CHECK(points_of(accessor_mesh(views, head + R"("bufferView": 0, )" + sparse, bytes.str())) ==
          std::vector<glm::vec3>{{10, 11, 12}, {3, 4, 5}, {13, 14, 15}});
    CHECK(points_of(accessor_mesh(views, head + sparse, bytes.str())) ==
          std::vector<glm::vec3>{{10, 11, 12}, {0, 0, 0}, {13, 14, 15}});
    CHECK(points_of(accessor_mesh(views, R"({"componentType": 5126, "count": 3, "type": "VEC3"})",
                                  bytes.str())) == std::vector<glm::vec3>(3, glm::vec3(0)));
    const std::string small = R"({"componentType": 5126, "count": 2, "type": "VEC3", )";
    CHECK(has(error(accessor_mesh(views, small + sparse, bytes.str())),
              "accessors[0]: sparse.indices: index 2 is out of range"));
    CHECK(has(error(accessor_mesh(views, R"({"componentType": 5126, "count": 2000000000,
"type": "VEC3"})",
                                  bytes.str())),
              "accessors[0]: 2000000000 elements of zeros"));

    // Indices without a view are zeros but for the sparse ones.
    Bytes with_indices;
    with_indices.add_text(square_buffer());
    with_indices.add<std::uint8_t>(1).add<std::uint8_t>(2).add<std::uint8_t>(3).add<std::uint8_t>(
        2);
    const MeshSource source = read_text(
        "a.gltf",
        document(
            R"("bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 52, "byteLength": 2},
{"buffer": 0, "byteOffset": 54, "byteLength": 2}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
{"componentType": 5121, "count": 3, "type": "SCALAR", "sparse": {"count": 2,
"indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 2}}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}])",
            with_indices.str()));
    CHECK(source.triangles == Triangles{{0, 3, 2}});
}

TEST_CASE("glTF: images, materials and extras are neither needed nor looked into") {
    CHECK(points_of(square(R"("images": [{"uri": "missing.png"}, {"bufferView": 99}, {"uri": 5}],
"textures": 3, "materials": [{"x": [1]}], "extras": {"a": null}, "animations": [{}],
"meshes": [{"extras": 1, "primitives": [{"material": 77, "attributes": {"POSITION": 0, "NORMAL": 99,
"_ODD": "x"}, "targets": [5], "mode": 0}, {"attributes": {"NORMAL": 0}}]}])"))
              .size() == 4);
}

TEST_CASE("glTF: what is wrong is named with its place") {
    const std::string mesh =
        R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}])";
    const std::string good = square(mesh);
    CHECK(error(good).empty());
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string bytes = good;
        const std::size_t at = bytes.find(from);
        REQUIRE(at != std::string::npos);
        return error(bytes.replace(at, from.size(), to));
    };
    CHECK(has(replaced(R"("version": "2.0")", R"("version": "1.0")"), "asset: glTF version '1.0'"));
    CHECK(has(replaced(R"("count": 4)", R"("count": 5)"), "accessors[0]: 5 elements reach beyond"));
    CHECK(
        has(replaced(R"("count": 4)", R"("count": 4294967300)"), "accessors[0].count: 4294967300"));
    CHECK(has(replaced(R"("count": 4)", R"("count": 4.0)"),
              "accessors[0].count: should be an integer"));
    CHECK(has(replaced(R"("count": 4)", R"("count": -4)"),
              "accessors[0].count: should be an integer"));
    CHECK(has(replaced(R"("count": 4, )", ""), "accessors[0]: has no 'count'"));
    CHECK(has(replaced(R"("bufferView": 0)", R"("bufferView": 9)"), "accessors[0]: bufferView 9"));
    CHECK(has(replaced(R"("bufferView": 0)", R"("bufferView": 0, "byteOffset": 4)"),
              "accessors[0]: 4 elements reach beyond"));
    CHECK(has(replaced(R"("bufferView": 0)", R"("bufferView": 0, "byteOffset": "4")"),
              "accessors[0].byteOffset: should be an integer"));
    CHECK(has(replaced(R"("bufferView": 0)", R"("bufferView": 0, "normalized": 1)"),
              "accessors[0].normalized: should be true or false"));
    CHECK(has(replaced("5126", "5124"), "accessors[0]: componentType 5124"));
    CHECK(has(replaced("VEC3", "VEC2"), "accessors[0]: should be of type VEC3"));
    CHECK(has(replaced(R"("byteLength": 48)", R"("byteLength": 49000)"),
              "bufferView 0 reaches beyond"));
    CHECK(has(replaced(R"("buffer": 0)", R"("buffer": 3)"), "bufferView 0 has no buffer"));
    CHECK(has(replaced(R"("POSITION": 0)", R"("POSITION": 9)"), "accessors[9]: does not exist"));
    CHECK(has(replaced("base64,", "base64,*"), "a.gltf: "));
    CHECK(has(replaced(R"("byteLength": 52)", R"("byteLength": 53)"),
              "buffers[0]: byteLength is 53 but 'data:application/octet-stream;base64,AAA...' has "
              "only 52"));
    CHECK(
        has(replaced(R"("mode": 0)", R"("indices": 0)"), "accessors[0]: should be of type SCALAR"));
    CHECK(has(
        replaced(R"("asset")", R"("extensionsRequired": ["KHR_draco_mesh_compression"], "asset")"),
        "extensionsRequired[0]: the file requires the extension 'KHR_draco_mesh_compression'"));
    CHECK(has(replaced(R"("asset")", R"("extensionsUsed": ["EXT_mesh_gpu_instancing"], "asset")"),
              "extensionsUsed[0]"));
    CHECK(has(replaced("\"meshes\"", "\"meshes"), "byte "));
    CHECK(has(error(with_nodes(R"("nodes": [{"mesh": 0, "matrix": [1, 2]}])")),
              "nodes[0].matrix: should have 16 numbers"));
    CHECK(has(error(with_nodes(R"("nodes": [{"mesh": 0, "scale": [1, "2", 3]}])")),
              "nodes[0].scale[1]: should be a number"));
    CHECK(has(error(with_nodes(R"("nodes": [{"mesh": 0, "rotation": [0, 0, 0, 0]}])")),
              "nodes[0]: its rotation is not a quaternion"));
    CHECK(has(error(with_nodes(R"("nodes": [{"mesh": 0, "translation": [1e300, 0, 0]}])")),
              "vertex 0 is beyond 2^60"));
    CHECK(has(error(with_nodes(
                  R"("nodes": [{"mesh": 0, "matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])")),
              "nodes[0]: its matrix is not affine"));
    CHECK(has(error(R"({"asset": {"version": "2.0"}, "x": )" + std::string(100000, '[')),
              "a.gltf: "));
    Bytes nan;
    nan.add(0.0f).add(NAN).add(0.0f);
    CHECK(has(
        error(accessor_mesh(
            R"({"buffer": 0, "byteLength": 12})",
            R"({"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC3"})", nan.str())),
        "meshes[0].primitives[0]: vertex 0 is not a finite position"));
    std::string buffer = square_buffer();
    buffer.back() = 4;
    CHECK(has(error(document(
                  k_square_accessors + R"(, "meshes": [{"primitives": [{"mode": 5, "indices": 1,
"attributes": {"POSITION": 0}}]}])",
                  buffer)),
              "index 4 (number 3) is out of range"));
}

TEST_CASE("glTF: buffers are taken from beside the file only, and must be as long as they say") {
    const ScratchFolder folder;
    folder.write("short.bin", "12345678");
    std::filesystem::create_directories(folder.path() / "sub");
    folder.write("sub/outside.gltf", "");
    const auto message = [&](const std::string& uri) {
        try {
            read_mesh_file(folder.write(
                "sub/a.gltf", sample_gltf(R"({"byteLength": 186, "uri": ")" + uri + "\"}")));
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    for (const char* uri : {"../short.bin", "%2e%2e/short.bin", "/dev/zero", "file:///etc/passwd",
                            "http://example.org/x.bin", "x/../../short.bin", "a%00b"}) {
        CAPTURE(uri);
        CHECK(has(message(uri), "does not name a file beside this one"));
    }
    CHECK(has(message("missing.bin"), "missing.bin: cannot open it"));
    CHECK(has(message("bad%zz"), "bad escape"));
    folder.write("sub/short.bin", "12345678");
    CHECK(has(message("short.bin"),
              "buffers[0]: byteLength is 186 but 'short.bin' has only 8 bytes"));
    CHECK(has(error_of("a.gltf", sample_gltf(R"({"byteLength": 186})")), "buffers[0]: has no uri"));
    CHECK(has(error_of("a.glb", glb_of(sample_gltf(R"({"byteLength": 186})"), "1234")),
              "the binary chunk has only 4 bytes"));
}

TEST_CASE("glTF: data URIs of any media type, with or without padding, escapes or base64") {
    const std::string data = base64(sample_gltf_buffer() + "x");
    REQUIRE(data.ends_with("=="));
    const std::string bare = data.substr(0, data.size() - 2);
    std::string escaped;
    for (const char c : sample_gltf_buffer()) {
        const auto byte = static_cast<unsigned char>(c);
        constexpr std::string_view k_hex = "0123456789aBcDeF";
        escaped.append(1, '%').append(1, k_hex[byte / 16]).append(1, k_hex[byte % 16]);
    }
    for (const std::string& uri : {"data:;base64," + data, "data:application/x-foo;base64," + data,
                                   "data:text/plain;charset=utf-8;base64," + data,
                                   "data:application/gltf-buffer;base64," + bare,
                                   "data:;base64," + bare + "%3D%3d", "data:," + escaped}) {
        CAPTURE(uri.substr(0, 40));
        const MeshSource source =
            read_text("a.gltf", sample_gltf(R"({"byteLength": 186, "uri": ")" + uri + "\"}"));
        CHECK(source.positions == sample_positions());
        CHECK(source.triangles == sample_triangles());
    }
    for (const std::string& uri :
         {"data:;base64,*" + data.substr(1), "data:;base64," + data.substr(1),
          "data:;base64," + bare + "=", "data:;base64,=" + data.substr(1),
          "data:;base64," + data.substr(0, 16), std::string("data:;base64"),
          "data:," + escaped + "%4"}) {
        CAPTURE(uri.substr(0, 40));
        const std::string message =
            error(sample_gltf(R"({"byteLength": 186, "uri": ")" + uri + "\"}"));
        CAPTURE(message);
        CHECK(message.starts_with("a.gltf: buffers[0]: "));
        CHECK(message.size() < 160);
    }
}

TEST_CASE("glTF: buffers may share a uri, and one that nobody needs may have none") {
    const ScratchFolder folder;
    folder.write("all.bin", sample_gltf_buffer());
    const auto with_second = [](const std::string& second) {
        std::string bytes = sample_gltf(R"({"byteLength": 186, "uri": "all.bin"}, )" + second);
        const std::string view = R"({"buffer": 0, "byteOffset": 156)";
        return bytes.replace(bytes.find(view), view.size(), R"({"buffer": 1, "byteOffset": 156)");
    };
    const MeshSource shared = read_mesh_file(
        folder.write("a.gltf", with_second(R"({"byteLength": 186, "uri": "all.bin"})")));
    CHECK(shared.positions == sample_positions());
    CHECK(shared.triangles == sample_triangles());
    CHECK(read_mesh_file(folder.write("b.gltf", sample_gltf(R"({"byteLength": 186,
"uri": "all.bin"}, {"byteLength": 4000000})")))
              .triangles == sample_triangles());
    CHECK_THROWS_WITH_AS(
        read_mesh_file(folder.write("c.gltf", with_second(R"({"byteLength": 186})"))),
        ((folder.path() / "c.gltf").string() +
         ": accessors[1]: buffers[1]: has no uri, and there is no binary chunk for it")
            .c_str(),
        Error);
}

TEST_CASE("glTF: a file that needs a later version than 2.0 is refused") {
    const auto with = [](const std::string& asset) {
        std::string bytes = sample_gltf_embedded();
        const std::string old = R"({"version": "2.0"})";
        return error(bytes.replace(bytes.find(old), old.size(), asset));
    };
    CHECK(with(R"({"version": "2.1"})").empty());
    CHECK(with(R"({"version": "2.1", "minVersion": "2.0"})").empty());
    CHECK(has(with(R"({"version": "2.1", "minVersion": "2.1"})"),
              "asset.minVersion: the file needs a reader of glTF version '2.1'"));
    CHECK(has(with(R"({"version": "2.0", "minVersion": "3.0"})"), "asset.minVersion: "));
    CHECK(has(with(R"({"version": "2.0", "minVersion": 2})"), "asset.minVersion: should be a str"));
}

TEST_CASE("glTF: however its path is spelled, a buffer's file is read once") {
    const ScratchFolder folder;
    std::filesystem::create_directories(folder.path() / "parts");
    folder.write("parts/a b.bin", "12345678");
    folder.write("parts/other.bin", "12345678");
    const SourceFile file{"a.gltf", {}, folder.path(), 0};
    std::vector<GltfBuffer> named;
    for (const char* uri : {"parts/a b.bin", "parts/a%20b.bin", "./parts/a b.bin",
                            "parts/./%61 b.bin", "parts//a b.bin", "parts%2fa b.bin"})
        named.push_back({8, uri});
    const GltfBuffers same(file, named, {}, {});
    CHECK(same.bytes_read() == 8);
    for (std::size_t i = 0; i < same.size(); ++i) {
        CHECK(same[i] == "12345678");
        CHECK(same[i].data() == same[0].data());
    }
    // What is embedded is no path, though a path may look like it.
    folder.write("data:,x", "1234");
    const GltfBuffers others(
        file, {{8, "parts/a b.bin"}, {8, "parts/other.bin"}, {1, "data:,x"}, {4, "data%3a,x"}}, {},
        {});
    CHECK(others.bytes_read() == 21);
    CHECK(others[1].data() != others[0].data());
    CHECK(others[2] == "x");
    CHECK(others[3] == "1234");

    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_WITH_AS(GltfBuffers(file, named, {}, stop.get_token()), "cancelled", Error);
}

TEST_CASE("glTF: points and lines that share their indices do not read them again and again") {
    constexpr std::size_t k_indices = 400000;
    const auto points = [&](const std::string& primitives) {
        return glb_of(
            R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 400048}], "bufferViews": [
{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 400000}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
{"bufferView": 1, "componentType": 5121, "count": 400000, "type": "SCALAR"},
{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"meshes": [{"primitives": [)" +
                primitives + "]}]}",
            square_buffer() + std::string(k_indices - 4, '\0'));
    };
    const std::string one = R"({"attributes": {"POSITION": 0}, "indices": 1, "mode": 0})";
    std::string many = one;
    for (int i = 1; i < 20000; ++i) many += "," + one;
    const ScratchFolder folder;
    const std::filesystem::path path = folder.write("a.glb", points(many));
    const auto begin = std::chrono::steady_clock::now();
    CHECK(read_mesh_file(path, FaceRequirement::faces_or_points).positions.size() == 80000);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    MESSAGE("20,000 primitives of 400,000 indices: " << took.count() << " s");
    CHECK(took.count() < 10.0);
    // Each primitive has vertices of its own that they are held against.
    CHECK(error_of("a.glb", points(one + R"(, {"attributes": {"POSITION": 2}, "indices": 1,
"mode": 1})")) ==
          "a.glb: meshes[0].primitives[1]: index 3 (number 3) is out of range; there are 3 "
          "vertices");
    CHECK(has(error_of("a.glb", points(one + R"(, {"attributes": {"POSITION": 0}, "indices": 1})")),
              "meshes[0].primitives[1]: 400000 corners do not make triangles"));
}

TEST_CASE("glTF: no accessor replaces more elements than it has") {
    Bytes bytes;
    bytes.add(1.0f).add(2.0f).add(3.0f).add(4.0f).add(5.0f).add(6.0f);
    bytes.add<std::uint8_t>(0).add<std::uint8_t>(0);
    const auto sparse = [&](const std::string& count) {
        return accessor_mesh(
            R"({"buffer": 0, "byteLength": 24}, {"buffer": 0, "byteOffset": 24, "byteLength": 2})",
            R"({"componentType": 5126, "count": 1, "type": "VEC3", "sparse": {"count": )" + count +
                R"(, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0}}})",
            bytes.str());
    };
    CHECK(points_of(sparse("1")) == std::vector<glm::vec3>{{1, 2, 3}});
    CHECK(has(error(sparse("2")),
              "accessors[0]: sparse.count: 2 elements are replaced, but there are only 1"));
}
