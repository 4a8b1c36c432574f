// Textures of OBJ and glTF: texture coordinates, and the pictures that read_textures() reads.

#include <algorithm>
#include <map>
#include <numbers>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/loop_subdivision.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

const std::string k_textured_square =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0 0\nvt 1 0.75\nvt 0\nmtllib colors.mtl\n";

std::string png_of(const Picture& picture) {
    const std::vector<std::byte> bytes = encode_png(picture);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

const Picture k_picture{2, 1, {255, 0, 0, 255, 0, 0, 255, 255}};

/// An OBJ beside a library and a picture red.png, with its textures.
MeshSource read_textured(const std::string& obj, const std::string& library) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path() / "maps");
    folder.write("colors.mtl", library);
    folder.write("red.png", png_of(k_picture));
    folder.write("maps/red two.png", png_of(k_picture));
    folder.write("damaged.png", png_of(k_picture).substr(0, 40));
    MeshSource source = read_mesh_file(folder.write("a.obj", k_textured_square + obj));
    read_textures(source);
    CHECK(tests::is_sound(source));
    return source;
}

// Corner c of face f, from the left top corner of the picture.
glm::vec2 uv(const MeshSource& source, std::size_t f, std::size_t c) {
    return source.materials.corner_uvs.at(3 * f + c);
}

const MaterialTexture& texture_of(const MeshSource& source, std::size_t f) {
    const TextureId texture = source.materials.texture_of(f);
    REQUIRE(texture != k_no_texture);
    return source.materials.textures[index(texture)];
}

// A glTF of a triangle with texture coordinates (0, 0), (1, 0) and (0.25, 0.5) in bytes, and these parts. The
// PNG is in the buffer view 3.
std::string textured_gltf(const std::string& use, const std::string& parts) {
    Bytes bytes;
    for (const float c : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) bytes.add(c);
    for (const float c : {0.0f, 0.0f, 1.0f, 0.0f, 0.25f, 0.5f}) bytes.add(c);
    for (const int c : {0, 0, 255, 0, 51, 102, 0, 0}) bytes.add(static_cast<std::uint8_t>(c));
    const std::string png = png_of(k_picture);
    bytes.add_text(png);
    const std::string size = std::to_string(png.size());
    return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": )" +
           std::to_string(68 + png.size()) + R"(, "uri": "data:;base64,)" + base64(bytes.str()) +
           R"("}], "bufferViews": [{"buffer": 0, "byteLength": 36},
{"buffer": 0, "byteOffset": 36, "byteLength": 24}, {"buffer": 0, "byteOffset": 60, "byteLength": 8},
{"buffer": 0, "byteOffset": 68, "byteLength": )" +
           size + R"(}, {"buffer": 0, "byteOffset": 68, "byteLength": 10000}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
{"bufferView": 2, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC2"},
{"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC2"}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2,
"TEXCOORD_2": 3, "TEXCOORD_3": 0}, "material": 0}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorTexture": )" +
           use + "}}], " + parts + "}";
}

const std::string k_parts =
    R"("textures": [{"source": 0}], "images": [{"bufferView": 3, "mimeType": "image/png"}])";

MeshSource read_gltf_with_textures(const std::string& document) {
    const ScratchFolder folder;
    folder.write("red two.png", png_of(k_picture));
    MeshSource source = read_mesh_file(folder.write("a.gltf", document));
    read_textures(source);
    CHECK(tests::is_sound(source));
    CHECK(source.triangles.size() == 1);
    return source;
}

}  // namespace

TEST_CASE("glTF: texture coordinates whose numbers glTF does not allow are a warning") {
    const std::string use = R"({"index": 0, "texCoord": 1})";
    const std::string found = R"(5121, "normalized": true)";
    std::string document = textured_gltf(use, k_parts);
    CHECK(read_gltf_with_textures(document).warnings.empty());
    document.replace(document.find(found), found.size(), "5121");
    const MeshSource source = read_gltf_with_textures(document);
    REQUIRE(source.warnings.size() == 1);
    CHECK(source.warnings[0].find("accessors[2]: holds texture coordinates, which should be") !=
          std::string::npos);
    // An extension allows them.
    document = R"({"extensionsUsed": ["KHR_mesh_quantization"], )" + document.substr(1);
    CHECK(read_gltf_with_textures(document).warnings.empty());
}

TEST_CASE("OBJ: corners have texture coordinates, and materials the pictures of map_Kd") {
    const MeshSource source = read_textured(
        "f 1/1 2/2 3/3\nusemtl red\nf 1/1 2/2 3/3 4/-1\nf 4 3/3/ 2//\nusemtl plain\nf 1/1 2/2 "
        "3/3\n",
        "newmtl red\nKd 0.5 0.5 0.5\nmap_Kd red.png\nnewmtl plain\nKd 1 0 0\n");
    CHECK(source.warnings.empty());
    REQUIRE(source.triangles.size() == 5);
    CHECK(source.materials.texture_of(0) == k_no_texture);
    CHECK(source.materials.texture_of(4) == k_no_texture);
    const std::map<std::uint32_t, glm::vec2> expected{
        {0, {0, 1}}, {1, {1, 1}}, {2, {1, 0.25f}}, {3, {0, 1}}};
    for (const std::size_t f : {1u, 2u}) {
        REQUIRE(texture_of(source, f).picture);
        CHECK(texture_of(source, f).picture->rgba == k_picture.rgba);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(uv(source, f, c) == expected.at(source.triangles[f][c]));
    }
    CHECK(uv(source, 3, 0) == glm::vec2(0));  // None in the file.
    CHECK(uv(source, 3, 1) == glm::vec2(1, 0.25f));
    CHECK(source.materials.has_pictures());
}

TEST_CASE("check_textures: the warnings of read_textures without the pictures") {
    const ScratchFolder folder;
    folder.write("colors.mtl",
                 "newmtl a\nmap_Kd red.png\nnewmtl b\nmap_Kd damaged.png\nnewmtl c\nmap_Kd "
                 "missing.png\nnewmtl d\nmap_Kd pointer.png\n");
    folder.write("red.png", png_of(k_picture));
    folder.write("damaged.png", png_of(k_picture).substr(0, 40));
    folder.write("pointer.png", "version https://git-lfs.github.com/spec/v1\n");
    const MeshSource source = read_mesh_file(folder.write(
        "a.obj", k_textured_square +
                     "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 2/2 "
                     "3/3\nusemtl d\nf 1/1 2/2 3/3\n"));
    MeshSource checked = source, read = source;
    check_textures(checked);
    read_textures(read);
    REQUIRE(checked.warnings.size() == 3);
    CHECK(checked.warnings == read.warnings);
    CHECK(std::ranges::any_of(checked.warnings, [](const std::string& warning) {
        return warning.find("pointer.png: it is a pointer of Git LFS") != std::string::npos;
    }));
    CHECK(read.materials.has_pictures());
    CHECK(!checked.materials.has_pictures());
}

TEST_CASE("OBJ: options of map_Kd, and names with spaces in folders") {
    const std::string obj = "usemtl a\nf 1/1 2/2 3/3\n";
    for (const std::string options :
         {"-s 2 4 1 -o 0.5 -0.25", "-blendu on -o .5 -.25 0 -cc off -mm 0 1 -s 2 4"}) {
        CAPTURE(options);
        const MeshSource source = read_textured(
            obj, "newmtl a\nmap_Kd " + options + " -clamp on maps\\red two.png  \r\n");
        CHECK(source.warnings.empty());
        CHECK(uv(source, 0, 0) == glm::vec2(0.5f, 1.25f));
        CHECK(uv(source, 0, 1) == glm::vec2(2.5f, 1.25f));
        CHECK(uv(source, 0, 2) == glm::vec2(2.5f, -1.75f));
        CHECK(texture_of(source, 0).wrap_u == TextureWrap::clamp);
        CHECK(texture_of(source, 0).wrap_v == TextureWrap::clamp);
        CHECK(texture_of(source, 0).picture != nullptr);
    }
    // A black surface would hide its texture.
    const auto base = [&](const std::string& kd) {
        const MeshSource source = read_textured(obj, "newmtl a\n" + kd + "map_Kd red.png\n");
        return source.materials.materials[0].base_color;
    };
    CHECK(base("Kd 0 0 0\n") == glm::vec3(1));
    CHECK(base("") == glm::vec3(1));
    CHECK(base("Kd 1 0 1\n") == glm::vec3(1, 0, 1));
}

TEST_CASE("OBJ: a texture that cannot be used is a warning with its file, and one color") {
    struct Bad {
        std::string map, warning;
    };
    for (const Bad& bad : {Bad{"gone.png", "gone.png: cannot open it"},
                           {"damaged.png", "PNG: "},
                           {"maps", "is a directory"},
                           {"a.obj", "neither a PNG nor a JPEG"},
                           {"../red.png", "does not name a file beside"},
                           {"/dev/zero", "does not name a file beside"},
                           {"", "map_Kd names no file"},
                           {"-s x red.png", "'x' is not a number"},
                           {"-o nan red.png", "'nan' is not a number"}}) {
        CAPTURE(bad.map);
        const MeshSource source = read_textured("usemtl a\nf 1/1 2/2 3/3\nf 1/1 2/2 3/3\n",
                                                "newmtl a\nKd 0 1 0\nmap_Kd " + bad.map + "\n");
        REQUIRE(source.warnings.size() == 1);
        CHECK(has(source.warnings[0], "colors.mtl:3: "));
        CHECK(has(source.warnings[0], bad.warning));
        CHECK(source.materials.materials[0].base_color == glm::vec3(0, 1, 0));
        CHECK(!source.materials.has_pictures());
    }
}

TEST_CASE(
    "OBJ: a polygon with thousands of corners, some of them at one vertex, keeps its own "
    "coordinates") {
    std::string obj, face = "usemtl a\nf";
    const int n = 5000;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        const std::string number = std::to_string(5 + i);
        obj.append("v ").append(std::to_string(std::cos(angle))).append(" ");
        obj.append(std::to_string(std::sin(angle))).append(" 1\nvt ");
        obj.append(std::to_string(i)).append(" 0\n");
        face.append(" ").append(number).append("/").append(number);
    }
    const MeshSource source = read_textured(obj + face + "\n", "newmtl a\nmap_Kd red.png\n");
    REQUIRE(source.triangles.size() == n - 2);
    int wrong = 0;
    for (std::size_t f = 0; f < source.triangles.size(); ++f)
        for (std::size_t c = 0; c < 3; ++c)
            wrong += uv(source, f, c).x != static_cast<float>(source.triangles[f][c] - 4);
    CHECK(wrong == 0);
}

TEST_CASE("textures of one file share its picture, and those that no face uses are not read") {
    const MeshSource source =
        read_textured("usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n",
                      "newmtl a\nmap_Kd red.png\nnewmtl b\nmap_Kd -clamp on red.png\nnewmtl c\n"
                      "map_Kd gone.png\n");
    CHECK(source.warnings.empty());
    CHECK(texture_of(source, 0).picture == texture_of(source, 1).picture);
    CHECK(texture_of(source, 0).wrap_u == TextureWrap::repeat);
}

TEST_CASE(
    "files that a model refers to are named, also those that no face uses or that are missing") {
    const ScratchFolder folder;
    folder.write("colors.mtl",
                 "newmtl red\nmap_Kd red.png\nnewmtl other\nmap_Kd maps/gone.png\n"
                 "newmtl outside\nmap_Kd ../red.png\n");
    const MeshSource obj = read_mesh_file(
        folder.write("a.obj", k_textured_square + "mtllib gone.mtl\nusemtl red\nf 1/1 2/2 3/3\n"));
    for (const char* name : {"colors.mtl", "red.png", "maps/gone.png", "gone.mtl"}) {
        CAPTURE(name);
        CHECK(std::ranges::find(obj.files, folder.path() / name) != obj.files.end());
    }
    CHECK(std::ranges::find(obj.files, folder.path() / "../red.png") == obj.files.end());
    CHECK(read_mesh_file(folder.write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"))
              .files.empty());
}

TEST_CASE("welding and subdivision keep textures") {
    const MeshSource source =
        read_textured("usemtl a\nf 1/1 2/2 3/3\nf 1/3 3/1 4/2\n", "newmtl a\nmap_Kd red.png\n");
    const Mesh mesh(source);
    CHECK(mesh.materials() == source.materials);
    const MeshSource fine = subdivide_loop(source, 1);
    CHECK(tests::is_sound(fine));
    CHECK(fine.materials.textures == source.materials.textures);
    CHECK(uv(fine, 0, 1) == glm::vec2(0.5f, 1));
    CHECK(uv(fine, 4, 0) == uv(source, 1, 0));
}

TEST_CASE("glTF: pictures in buffers, in files and in data URIs") {
    for (const std::string& image :
         {std::string(R"({"bufferView": 3})"), std::string(R"({"uri": "red%20two.png"})"),
          R"({"uri": "data:image/png;base64,)" + base64(png_of(k_picture)) + "\"}"}) {
        CAPTURE(image);
        const MeshSource source = read_gltf_with_textures(textured_gltf(
            R"({"index": 0})", R"("textures": [{"source": 0}], "images": [)" + image + "]"));
        CHECK(source.warnings.empty());
        REQUIRE(texture_of(source, 0).picture);
        CHECK(texture_of(source, 0).picture->rgba == k_picture.rgba);
        CHECK(texture_of(source, 0).embedded == nullptr);
        CHECK(uv(source, 0, 1) == glm::vec2(1, 0));
        CHECK(uv(source, 0, 2) == glm::vec2(0.25f, 0.5f));
    }
}

TEST_CASE("glTF: samplers, sets of coordinates and KHR_texture_transform") {
    const MeshSource second =
        read_gltf_with_textures(textured_gltf(R"({"index": 0, "texCoord": 1})", k_parts));
    CHECK(uv(second, 0, 2).x == doctest::Approx(0.2));
    CHECK(uv(second, 0, 2).y == doctest::Approx(0.4));

    const MeshSource sampled = read_gltf_with_textures(
        textured_gltf(R"({"index": 0})",
                      R"("textures": [{"source": 0, "sampler": 0}], "images": [{"bufferView": 3}],
           "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}])"));
    CHECK(texture_of(sampled, 0).wrap_u == TextureWrap::clamp);
    CHECK(texture_of(sampled, 0).wrap_v == TextureWrap::mirror);
    CHECK(texture_of(sampled, 0).is_pixelated);

    // A quarter turn, counter-clockwise where v points down: (u, v) becomes (v, -u).
    const MeshSource turned = read_gltf_with_textures(textured_gltf(
        R"({"index": 0, "texCoord": 7, "extensions": {"KHR_texture_transform":
            {"offset": [0.5, 2], "rotation": 1.5707963267948966, "scale": [2, 4], "texCoord": 0}}})",
        k_parts));
    CHECK(turned.warnings.empty());
    CHECK(uv(turned, 0, 1).x == doctest::Approx(0.5));
    CHECK(uv(turned, 0, 1).y == doctest::Approx(0));
    CHECK(uv(turned, 0, 2).x == doctest::Approx(0.5 + 4 * 0.5));
    CHECK(uv(turned, 0, 2).y == doctest::Approx(2 - 2 * 0.25));
}

TEST_CASE("glTF: a texture that cannot be used is a warning with its place, never an error") {
    struct Bad {
        std::string use, parts, warning;
    };
    const std::string texture = R"("textures": [{"source": 0}], )";
    for (const Bad& bad : {
             Bad{R"({"index": 1})", k_parts,
                 "baseColorTexture.index: 1 does not exist in textures"},
             {"{}", k_parts, "baseColorTexture: has no 'index'"},
             {"7", k_parts, "baseColorTexture: should be an object"},
             {R"({"index": "a"})", k_parts, "should be an integer"},
             {R"({"index": 0})", R"("textures": [{}])", "textures[0]: has no 'source'"},
             {R"({"index": 0})", R"("textures": {})", "does not exist in textures"},
             {R"({"index": 0})", texture + R"("images": [])", "0 does not exist in images"},
             {R"({"index": 0})", texture + R"("images": [{}])", "images[0]: has no 'bufferView'"},
             {R"({"index": 0})", texture + R"("images": [{"bufferView": 4}])", "ends beyond"},
             {R"({"index": 0})", texture + R"("images": [{"bufferView": 9}])",
              "9 does not exist in bufferViews"},
             {R"({"index": 0})", texture + R"("images": [{"bufferView": 0}])",
              "images[0]: neither a PNG nor a JPEG file"},
             {R"({"index": 0})", texture + R"("images": [{"uri": "../red.png"}])",
              "does not name a file beside"},
             {R"({"index": 0})", texture + R"("images": [{"uri": "gone.png"}])", "cannot open it"},
             {R"({"index": 0})", texture + R"("images": [{"uri": "data:;base64,!"}])", "base64"},
             {R"({"index": 0, "texCoord": 2})", k_parts, "has 2 elements for 3 vertices"},
             {R"({"index": 0, "texCoord": 3})", k_parts, "should be of type VEC2"},
             {R"({"index": 0, "texCoord": 4})", k_parts, "has no TEXCOORD_4"},
             {R"({"index": 0, "extensions": {"KHR_texture_transform": {"scale": [1]}}})", k_parts,
              "should have 2 numbers"},
         }) {
        CAPTURE(bad.use);
        CAPTURE(bad.parts);
        const MeshSource source = read_gltf_with_textures(textured_gltf(bad.use, bad.parts));
        REQUIRE(source.warnings.size() == 1);
        CAPTURE(source.warnings[0]);
        CHECK(has(source.warnings[0], "a.gltf: "));
        CHECK(has(source.warnings[0], bad.warning));
    }
}
