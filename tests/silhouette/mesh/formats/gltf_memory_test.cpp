#include <new>

#include "tests/silhouette/mesh/formats/sample_files.h"
#include "tests/silhouette/mesh/formats/watched_new.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

// Two instances with a matrix and parts, a texture of a picture in a buffer, colors, sparse positions, names.
std::string rich_gltf() {
    Bytes bytes;
    for (const glm::vec3 p : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
        bytes.add(p.x).add(p.y).add(p.z);
    for (const float uv : {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f}) bytes.add(uv);
    bytes.add(5.0f).add(6.0f).add(7.0f).add<std::uint8_t>(1);
    const std::string buffer = bytes.str();
    return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": )" +
           std::to_string(buffer.size()) + R"(, "uri": "data:application/octet-stream;base64,)" +
           base64(buffer) + R"("}], "bufferViews": [{"buffer": 0, "byteLength": 36},
{"buffer": 0, "byteOffset": 36, "byteLength": 24}, {"buffer": 0, "byteOffset": 60, "byteLength": 12},
{"buffer": 0, "byteOffset": 72, "byteLength": 1}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "sparse": {"count": 1,
"indices": {"bufferView": 3, "componentType": 5121}, "values": {"bufferView": 2}}},
{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
"images": [{"bufferView": 1}, {"uri": "a picture with a long name.png"}], "samplers": [{"wrapS": 33071}],
"textures": [{"source": 0, "sampler": 0}, {"source": 1}, {"source": 9}],
"materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "baseColorTexture": {"index": 0}}},
{"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}},
{"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}}],
"meshes": [{"name": "a mesh with a name that is longer than others", "primitives": [
{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 0}, "material": 0},
{"attributes": {"POSITION": 0}, "material": 1}]}], "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"children": [1, 2]}, {"mesh": 0, "translation": [1, 2, 3]},
{"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 9,0,0,1]}]})";
}

// The number of the first allocation that is not made any more.
std::uint64_t fail_each_allocation(const std::string& name, const std::string& bytes,
                                   const MeshSource& expected, bool and_all_later) {
    for (std::uint64_t i = 0;; ++i) {
        CAPTURE(i);
        std::string copy = bytes;
        const std::string extension = name.substr(name.find('.'));
        bool is_refused = false;
        MeshSource read;
        arm_new(i, and_all_later);
        try {
            read = read_mesh_bytes(name, std::move(copy), extension);
        } catch (const Error& e) {
            is_refused = e.code() == ErrorCode::too_large;
        } catch (const std::bad_alloc&) {
            is_refused = and_all_later;  // There was not even memory for the message.
        }
        if (!disarm_new()) {
            CHECK(read.positions == expected.positions);
            return i;
        }
        REQUIRE(is_refused);
    }
}

// Bytes per byte of a document while it is read.
double peak_of(const std::string& document) {
    const PeakBytes peak;
    try {
        read_mesh_bytes("a.gltf", document, ".gltf", FaceRequirement::faces_or_points);
    } catch (const Error& e) {
        CHECK(e.code() == ErrorCode::bad_input);
    }
    return static_cast<double>(peak.bytes()) / static_cast<double>(document.size());
}

}  // namespace

TEST_CASE("glTF: whichever allocation fails, reading ends with an error and without a crash") {
    for (const auto& [name, bytes] :
         {SampleFile{"rich.gltf", rich_gltf()}, SampleFile{"sample.glb", sample_glb()}}) {
        CAPTURE(name);
        const MeshSource expected = read_text(name, bytes);
        const std::uint64_t count = fail_each_allocation(name, bytes, expected, false);
        MESSAGE(name << ": " << count << " allocations");
        CHECK(count > 20);
        fail_each_allocation(name, bytes, expected, true);
    }
}

TEST_CASE(
    "glTF: whatever a document consists of it takes at most 20 times its size while it is read" *
    doctest::test_suite("plain")) {
    const auto document = [](const std::string& head, const std::string& element,
                             const std::string& tail) {
        std::string text = R"({"asset": {"version": "2.0"}, )" + head + element;
        while (text.size() < 3000000) text.append(",").append(element);
        return text + tail + "}";
    };
    struct Shape {
        std::string head, element, tail;
    };
    for (const Shape& shape : {
             Shape{R"("extras": [)", "0", "]"},
             Shape{R"("extras": [)", "[]", "]"},
             Shape{R"("extras": [)", R"("")", "]"},
             Shape{R"("extras": [{)", R"("":0)", "}]"},
             Shape{R"("scenes": [)", "{}", "]"},
             Shape{R"("nodes": [)", "{}", "]"},
             Shape{R"("nodes": [{"children": [)", "1", "]}]"},
             Shape{R"("nodes": [)", R"({"mesh":0})", "]"},
             Shape{R"("nodes": [)", R"({"scale":[1,1,1]})", "]"},
             Shape{R"("nodes": [{}], "scenes": [{"nodes": [)", "0", "]}]"},
             Shape{R"("materials": [)", "{}", "]"},
             Shape{R"("textures": [)", "0", R"(], "materials": [{}])"},
             Shape{R"("meshes": [{"primitives": [)", R"({"attributes":{}})", "]}]"},
             Shape{R"("meshes": [)", R"({"primitives":[{"attributes":{}}]})", "]"},
             Shape{R"("bufferViews": [)", R"({"buffer":0,"byteLength":0})", "]"},
             Shape{R"("accessors": [)", R"({"componentType":0,"count":0,"type":"VEC3"})", "]"},
             Shape{R"("images": [{"uri": "a.png"}], "textures": [{"source": 0}], "materials": [)",
                   R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})", "]"},
             Shape{R"("images": [{"uri": "data:,)", std::string(1000, 'a'), R"("}])"},
         }) {
        const std::string name = (shape.head + shape.element).substr(0, 60);
        CAPTURE(name);
        const double peak = peak_of(document(shape.head, shape.element, shape.tail));
        MESSAGE(peak << " bytes per byte");
        CHECK(peak < 20.0);
    }
}
