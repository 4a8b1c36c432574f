// Colors of files: of materials and of vertices, in every format that has them.

#include <algorithm>
#include <cmath>
#include <random>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/loop_subdivision.h"
#include "silhouette/srgb.h"
#include "tests/silhouette/mesh/formats/read_colors.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

const std::string k_flat_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string k_library =
    "# made by a test\nnewmtl red\nKd 1 0 0\nNs 5\nnewmtl gray\nKd 0.5\nnewmtl half green\nKd 0 "
    "0.5 0\n"
    "newmtl plain\nKa 1 1 1\n";

/// An OBJ beside a library colors.mtl.
MeshSource read_with_library(const std::string& obj, const std::string& library = k_library) {
    const ScratchFolder folder;
    folder.write("colors.mtl", library);
    return read_mesh_file(folder.write("a.obj", obj));
}

const glm::vec3 k_red(1, 0, 0);
const glm::vec3 k_gray = linear_from_srgb(glm::vec3(0.5f));
const glm::vec3 k_half_green = linear_from_srgb(glm::vec3(0, 0.5f, 0));

// A document with four vertices in a square, colors as floats, bytes and shorts, and the given parts.
std::string gltf(const std::string& parts) {
    Bytes bytes;
    for (const glm::vec3 p :
         {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(1, 1, 0)})
        bytes.add(p.x).add(p.y).add(p.z);
    for (const float c :
         {1.0f, 0.0f, 0.0f, 0.0f, 0.25f, 0.0f, 0.0f, 0.0f, 0.5f, 2.0f, -1.0f, 0.75f})
        bytes.add(c);
    for (const int c : {255, 0, 0, 9, 0, 51, 0, 9, 0, 0, 102, 9, 255, 0, 255, 9})
        bytes.add(static_cast<std::uint8_t>(c));
    for (const int c : {65535, 0, 0, 0, 13107, 0, 0, 0, 26214, 65535, 0, 65535})
        bytes.add(static_cast<std::uint16_t>(c));
    return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 136, "uri": "data:;base64,)" +
           base64(bytes.str()) + R"("}], "bufferViews": [{"buffer": 0, "byteLength": 48},
{"buffer": 0, "byteOffset": 48, "byteLength": 48}, {"buffer": 0, "byteOffset": 96, "byteLength": 16},
{"buffer": 0, "byteOffset": 112, "byteLength": 24}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
{"bufferView": 2, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"},
{"bufferView": 3, "componentType": 5123, "normalized": true, "count": 4, "type": "VEC3"},
{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
{"bufferView": 1, "componentType": 5126, "count": 12, "type": "SCALAR"}], )" +
           parts + "}";
}

// A mesh of strips of two triangles with these properties.
std::string strips(const std::vector<std::string>& properties,
                   const std::string& materials = "[]") {
    std::string primitives;
    for (const std::string& p : properties)
        primitives +=
            (primitives.empty() ? "" : ", ") + (R"({"mode": 5, "attributes": {"POSITION": 0)" + p);
    return gltf(R"("materials": )" + materials + R"(, "meshes": [{"primitives": [)" + primitives +
                "]}]");
}

FaceMaterials materials_of(const std::string& document) {
    const MeshSource source = read_text("a.gltf", document);
    CHECK(source.warnings.empty());
    CHECK(are_materials_of(source.materials, source.triangles.size()));
    return source.materials;
}

}  // namespace

TEST_CASE("OBJ: faces have the Kd of their materials, and all triangles of a polygon have one") {
    const MeshSource source = read_with_library(k_flat_square +
                                                "f 1 2 3\nusemtl gray\nmtllib colors.mtl\nf 1 2 3 "
                                                "4\nusemtl half green\nf 1 2 3\nusemtl red\n"
                                                "usemtl gray\nf 1 2 3\nusemtl plain\nf 1 2 3\n");
    CHECK(source.warnings.empty());
    REQUIRE(source.triangles.size() == 6);
    REQUIRE(are_materials_of(source.materials, 6));
    CHECK(colors_of(source.materials, 0).empty());
    CHECK(colors_of(source.materials, 1) == plain(k_gray));
    CHECK(colors_of(source.materials, 2) == plain(k_gray));
    CHECK(colors_of(source.materials, 3) == plain(k_half_green));
    CHECK(colors_of(source.materials, 4) == plain(k_gray));
    CHECK(colors_of(source.materials, 5).empty());
}

TEST_CASE("OBJ and glTF: a translucent material is taken as opaque with a warning") {
    const auto warnings_of = [](const std::string& lines) {
        const MeshSource source =
            read_with_library(k_flat_square + "mtllib colors.mtl\nusemtl red\nf 1 2 3\n",
                              "newmtl red\n" + lines + "Kd 1 0 0\n");
        CHECK(colors_of(source.materials, 0) == plain(k_red));
        return source.warnings;
    };
    for (const char* opaque : {"d 1\n", "d -halo 1.0\n", "Tr 1\n", "d\n", "illum 2\n"})
        CHECK(warnings_of(opaque).empty());
    for (const char* clear : {"d 0.3\n", "D -halo 0\n"}) {
        REQUIRE(warnings_of(clear).size() == 1);
        CHECK(has(warnings_of(clear)[0], "colors.mtl:2: d '"));
        CHECK(has(warnings_of(clear)[0], "translucent; it is taken as opaque"));
    }
    const auto gltf_warnings = [](const std::string& mode, const std::string& alpha) {
        const MeshSource source = read_text(
            "a.gltf", strips({R"(}, "material": 0})"},
                             R"([{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, )" + alpha +
                                 R"(]}, "name": "x")" + mode + "}]"));
        CHECK(colors_of(source.materials, 0) == plain(k_red));
        return source.warnings;
    };
    CHECK(gltf_warnings("", "0.2").empty());
    CHECK(gltf_warnings(R"(, "alphaMode": "OPAQUE")", "0.2").empty());
    CHECK(gltf_warnings(R"(, "alphaMode": "BLEND")", "1").empty());
    CHECK(gltf_warnings(R"(, "alphaMode": "MASK")", "0.6").empty());
    for (const char* mode :
         {R"("alphaMode": "BLEND")", R"("alphaMode": "MASK", "alphaCutoff": 0.7)"}) {
        const std::vector<std::string> warnings = gltf_warnings(std::string(", ") + mode, "0.6");
        REQUIRE(warnings.size() == 1);
        CHECK(has(warnings[0], "a.gltf: materials[0]: the material is translucent"));
    }
}

TEST_CASE("glTF: a material that is cut out by its texture is taken as opaque with one warning") {
    const auto warnings_of = [](const std::string& mode, const std::string& model) {
        std::vector<std::string> warnings;
        for (const std::string& warning :
             read_text("a.gltf", strips({R"(}, "material": 0})"}, R"([{"pbrMetallicRoughness": {)" +
                                                                      model + "}" + mode + "}]"))
                 .warnings)
            if (has(warning, "taken as opaque")) warnings.push_back(warning);
        return warnings;
    };
    const std::string texture = R"("baseColorTexture": {"index": 0})";
    const std::string clear = R"(, "baseColorFactor": [1, 1, 1, 0.2])";
    const std::string mask = R"(, "alphaMode": "MASK")";
    CHECK(warnings_of("", texture).empty());
    CHECK(warnings_of(R"(, "alphaMode": "BLEND")", texture).empty());
    CHECK(warnings_of(mask, "").empty());
    CHECK(warnings_of(mask + R"(, "alphaCutoff": 0)", texture).empty());
    for (const std::string& model : {texture, texture + clear}) {
        const std::vector<std::string> warnings = warnings_of(mask, model);
        REQUIRE(warnings.size() == 1);
        const char* why = model == texture ? "cut out by the alpha of its texture" : "translucent";
        CHECK(has(warnings[0], std::string("a.gltf: materials[0]: the material is ") + why));
    }
}

TEST_CASE("OBJ: keywords and options of libraries may have letters of any case but names may not") {
    const std::string obj =
        k_flat_square + "mtllib colors.mtl\nusemtl Red\nf 1 2 3\nusemtl red\nf 1 2 3\n";
    const MeshSource source = read_with_library(
        obj, "NewMtl Red\nKD 1 0 0\nnewmtl red\nkd 0 0.5 0\nMAP_KD -S 2 3 -CLAMP ON 1 a.png\n");
    CHECK(source.warnings.empty());
    CHECK(colors_of(source.materials, 0) == plain(k_red));
    CHECK(colors_of(source.materials, 1) == plain(k_half_green));
    REQUIRE(source.materials.textures.size() == 1);
    CHECK(source.materials.textures[0].path.filename() == "1 a.png");
    CHECK(source.materials.textures[0].wrap_u == TextureWrap::clamp);
    CHECK(has(read_with_library(obj, "NEWMTL red\nKD x\n").warnings[0], "colors.mtl:2: 'x'"));
}

TEST_CASE("OBJ: a warning shows control characters of a library's name as numbers") {
    const MeshSource source = read_with_library(k_flat_square + "mtllib a\x7f.mtl\nf 1 2 3\n");
    REQUIRE(source.warnings.size() == 1);
    CAPTURE(source.warnings[0]);
    CHECK(source.warnings[0].find(R"(a\x7f.mtl: cannot open it)") != std::string::npos);
}

TEST_CASE(
    "OBJ: names of libraries and materials may hold spaces and '#', and end before a comment") {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path() / "sub");
    folder.write("two words.mtl", "newmtl a\nKd 1 0 0\n");
    folder.write("sub/b.mtl", "\xef\xbb\xbfnewmtl Material #25 \r\nKd 0 0.5 0\r\n");
    folder.write("c.mtl", "newmtl c\nKd 0.5 0.5 0.5\nnewmtl a\nKd 0 0 1\n");
    const MeshSource source = read_mesh_file(folder.write(
        "a.obj",
        k_flat_square +
            "mtllib two words.mtl\nmtllib .\\sub\\b.mtl ./c.mtl\nusemtl a # not b\nf 1 2 3\n"
            "usemtl Material #25\nf 1 2 3\nusemtl c\nf 1 2 3\n"));
    CHECK(source.warnings.empty());
    CHECK(colors_of(source.materials, 0) == plain(k_red));
    CHECK(colors_of(source.materials, 1) == plain(k_half_green));
    CHECK(colors_of(source.materials, 2) == plain(k_gray));
}

TEST_CASE(
    "OBJ: a library that is missing, elsewhere or no file is a warning with its name and line") {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path() / "inner");
    folder.write("secret.mtl", k_library);
    const auto warnings = [&](const std::string& name) {
        const MeshSource source = read_mesh_file(folder.write(
            "inner/a.obj", k_flat_square + "mtllib " + name + "\nusemtl red\nf 1 2 3\n"));
        CHECK(source.triangles == Triangles{{0, 1, 2}});
        CHECK(source.materials == FaceMaterials{});
        return source.warnings;
    };
    for (const std::string& name :
         {std::string("gone.mtl"), std::string("."), std::string(".."),
          std::string("../secret.mtl"), std::string("/dev/zero"),
          (folder.path() / "secret.mtl").string(), std::string("C:\\secret.mtl"),
          std::string("x/../../secret.mtl")}) {
        CAPTURE(name);
        const std::vector<std::string> given = warnings(name);
        REQUIRE(given.size() == 1);
        CHECK(given[0].starts_with((folder.path() / "inner/a.obj").string() + ":5: "));
        // Long names are shortened.
        CHECK(has(given[0], name == "." ? "directory" : name.substr(0, 40)));
    }
    CHECK(warnings("gone.mtl lost.mtl").size() == 2);
    CHECK(warnings("gone.mtl ./gone.mtl gone.mtl").size() == 1);
    CHECK(warnings("").empty());
    std::string many;
    for (int i = 0; i < 1000; ++i) many += std::to_string(i) + ".mtl ";
    CHECK(warnings(many).size() == 21);
}

TEST_CASE(
    "OBJ: a faulty line of a library is a warning with its line, and its material has no color") {
    for (const std::string kd : {"Kd x 0 0", "Kd 1 0", "Kd", "Kd 1 0 0 0", "Kd nan 0 0",
                                 "Kd 1 inf 0", "Kd spectral a.rfl", "Kd xyz 1 1 1", "Kd 1,0 0 0"}) {
        CAPTURE(kd);
        const MeshSource source = read_with_library(
            k_flat_square + "mtllib colors.mtl\nusemtl bad\nf 1 2 3\nusemtl red\nf 1 2 3\n",
            "newmtl bad\n" + kd + "\nnewmtl red\nKd 1 0 0\n");
        REQUIRE(source.warnings.size() == 1);
        CHECK(has(source.warnings[0], "colors.mtl:2: "));
        CHECK(colors_of(source.materials, 0).empty());
        CHECK(colors_of(source.materials, 1) == plain(k_red));
    }
    // Any bytes may follow a keyword that is not read.
    const MeshSource source =
        read_with_library(k_flat_square + "mtllib colors.mtl\nusemtl red\nf 1 2 3\n",
                          std::string("Kd 9\n\0\xff\n", 8) + "newmtl red\nmap_Ks \\\nKd 2 -1 0");
    CHECK(source.warnings.empty());
    CHECK(colors_of(source.materials, 0) == plain(k_red));
}

TEST_CASE("OBJ: a material that no library has is a warning once, unless a library is missing") {
    const std::string faces = "usemtl lost\nf 1 2 3\nusemtl red\nf 1 2 3\nusemtl lost\nf 1 2 3\n";
    const MeshSource source = read_with_library(k_flat_square + "mtllib colors.mtl\n" + faces);
    REQUIRE(source.warnings.size() == 1);
    CHECK(has(source.warnings[0], "a.obj:6: no material library has a material 'lost'"));
    CHECK(colors_of(source.materials, 0).empty());
    CHECK(colors_of(source.materials, 1) == plain(k_red));
    CHECK(colors_of(source.materials, 2).empty());
    CHECK(
        read_with_library(k_flat_square + "mtllib colors.mtl gone.mtl\n" + faces).warnings.size() ==
        1);
    CHECK(read_with_library(k_flat_square + faces).warnings.empty());
}

TEST_CASE(
    "OBJ: vertices have colors up to 1 or up to 255, and their corners carry the material's too") {
    for (const std::string scale : {"1", "255"}) {
        const std::string half = scale == "1" ? "0.5" : "127.5";
        const std::string vertices =
            "v 0 0 0 " + scale + " 0 0\nv 1 0 0\nv 1 1 0 0 " + half + " 0 1\n";
        const MeshSource bare = read_text("a.obj", vertices + "f 1 2 3\n");
        CHECK(colors_of(bare.materials, 0) == std::vector{k_red, glm::vec3(1), k_half_green});
        const MeshSource both =
            read_with_library("mtllib colors.mtl\n" + vertices + "f 1 2 3\nusemtl gray\nf 3 2 1\n");
        CHECK(colors_of(both.materials, 0) == std::vector{k_red, glm::vec3(1), k_half_green});
        CHECK(colors_of(both.materials, 1) ==
              std::vector{k_gray * k_half_green, k_gray, k_gray * k_red});
    }
    CHECK(read_text("a.obj", "v 0 0 0 1\nv 1 0 0 1\nv 1 1 0 1\nf 1 2 3\n").materials.empty());
}

TEST_CASE("PLY: vertices have colors of any type, before or after the faces") {
    const auto text = [](const std::string& type, const std::string& full,
                         const std::string& half) {
        return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty " + type +
               " green\nproperty float y\nproperty " + type + " red\nproperty float z\nproperty " +
               type +
               " blue\nproperty uchar alpha\nelement face 1\nproperty list uchar int "
               "vertex_indices\n"
               "end_header\n0 0 0 " +
               full + " 0 0 7\n1 0 0 0 0 0 7\n1 " + half + " 1 0 0 0 7\n3 0 1 2\n";
    };
    const std::vector expected{k_red, glm::vec3(0),
                               linear_from_srgb(glm::vec3(0, 51.0f / 255.0f, 0))};
    for (const auto& [type, full, half] : {std::array<std::string, 3>{"uchar", "255", "51"},
                                           {"ushort", "65535", "13107"},
                                           {"float", "1", "0.2"},
                                           {"float", "7", "0.2"}}) {
        CAPTURE(type);
        const MeshSource source = read_text("a.ply", text(type, full, half));
        REQUIRE(are_materials_of(source.materials, 1));
        const std::vector<glm::vec3> colors = colors_of(source.materials, 0);
        REQUIRE(colors.size() == 3);
        for (std::size_t c = 0; c < 3; ++c)
            for (int i = 0; i < 3; ++i) CHECK(colors[c][i] == doctest::Approx(expected[c][i]));
    }
    Bytes bytes;
    bytes.add_text(
        "ply\nformat binary_little_endian 1.0\nelement face 1\n"
        "property list uchar uchar vertex_index\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
        "property uchar blue\nend_header\n");
    for (const int i : {4, 0, 1, 2, 3}) bytes.add(static_cast<std::uint8_t>(i));
    for (int i = 0; i < 4; ++i) {
        bytes.add(i % 3 == 0 ? 0.0f : 1.0f).add(i < 2 ? 0.0f : 1.0f).add(0.0f);
        for (int c = 0; c < 3; ++c) bytes.add(static_cast<std::uint8_t>(c == i ? 255 : 0));
    }
    const MeshSource source = read_text("a.ply", bytes.str());
    REQUIRE(source.triangles.size() == 2);
    for (std::size_t f = 0; f < 2; ++f)
        for (std::size_t c = 0; c < 3; ++c) {
            glm::vec3 own(0.0f);
            if (source.triangles[f][c] < 3) own[static_cast<int>(source.triangles[f][c])] = 1.0f;
            CHECK(colors_of(source.materials, f)[c] == own);
        }
}

TEST_CASE("PLY: colors may have the names diffuse_red or r and the first complete triple counts") {
    const auto read = [](const std::vector<std::string>& names, const std::string& type,
                         const std::string& numbers) {
        std::string properties;
        for (const std::string& name : names) properties += "property " + type + " " + name + "\n";
        return read_text(
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\n" +
                properties +
                "element face 1\n"
                "property list uchar int vertex_indices\n" +
                properties + "end_header\n0 0 0 " + numbers + "\n1 0 0 " + numbers + "\n0 1 0 " +
                numbers + "\n3 0 1 2 " + numbers + "\n");
    };
    // Those of vertices times those of the face.
    const glm::vec3 color = linear_from_srgb({1, 51.0f / 255.0f, 0});
    const std::vector<std::string> diffuse{"diffuse_red", "diffuse_green", "diffuse_blue"};
    const std::vector<std::string> letters{"r", "g", "b"};
    for (const auto& names : {diffuse, letters}) {
        CHECK(colors_of(read(names, "uchar", "255 51 0").materials, 0) == plain(color * color));
        const glm::vec3 read_floats =
            colors_of(read(names, "float", "1 0.2 nan").materials, 0).at(2);
        for (int i = 0; i < 3; ++i) CHECK(read_floats[i] == doctest::Approx((color * color)[i]));
    }
    std::vector<std::string> both{"red", "green", "alpha"};
    both.insert(both.end(), diffuse.begin(), diffuse.end());
    CHECK(colors_of(read(both, "uchar", "9 9 9 255 51 0").materials, 0) == plain(color * color));
    both[2] = "blue";
    CHECK(colors_of(read(both, "uchar", "255 51 0 9 9 9").materials, 0) == plain(color * color));
    CHECK(read({"diffuse_red", "green", "b"}, "uchar", "255 51 0").materials.empty());
}

TEST_CASE("glTF: a material of specular color and glossiness has its diffuse color") {
    const auto model = [](const std::string& glossy, const std::string& other = "") {
        return "[{" + other + R"("extensions": {"KHR_materials_pbrSpecularGlossiness": )" + glossy +
               "}}]";
    };
    const std::string use = R"(}, "material": 0})";
    const std::string metal = R"("pbrMetallicRoughness": {"baseColorFactor": [0.25, 0, 0, 1]}, )";
    const std::string green = R"({"diffuseFactor": [0, 0.5, 2, 1], "glossinessFactor": 0.5})";
    const std::string textured =
        R"({"diffuseFactor": [0, 0.5, 1, 1], "diffuseTexture": {"index": 0}})";
    const auto colors = [&](const std::string& materials) {
        return colors_of(read_text("a.gltf", strips({use}, materials)).materials, 0);
    };
    CHECK(colors(model(green)) == plain({0, 0.5f, 1}));
    CHECK(colors(model("{}")).empty());
    CHECK(colors(model(green, R"("pbrMetallicRoughness": {"metallicFactor": 0}, )")) ==
          plain({0, 0.5f, 1}));
    // The color of metals is not diffuse: where both models have one, that of metal and roughness counts.
    CHECK(colors(model(green, metal)) == plain({0.25f, 0, 0}));
    CHECK(colors(model(textured, metal)) == plain({0, 0.5f, 1}));
    const auto error = [&](const std::string& materials) {
        return error_of("a.gltf", strips({use}, materials));
    };
    const std::string place = "materials[0].extensions.KHR_materials_pbrSpecularGlossiness";
    CHECK(has(error(model("1")), place + ": should be an object"));
    CHECK(has(error(model(R"({"diffuseFactor": [1, 1, 1]})")),
              place + ".diffuseFactor: should have 4 numbers"));
    // The document has no textures.
    const MeshSource source = read_text("a.gltf", strips({use}, model(textured)));
    REQUIRE(source.warnings.size() == 1);
    CHECK(has(source.warnings[0], place + ".diffuseTexture"));
}

TEST_CASE("glTF: triangles have the base color of their material, as it is written") {
    const std::string materials =
        R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 2, 0.1]}}, {},
            {"pbrMetallicRoughness": {}}, {"pbrMetallicRoughness": {"baseColorFactor": [0, 0.5, 1, 1]}}])";
    const FaceMaterials read =
        materials_of(strips({R"(}, "material": 3})", "}}", R"(}, "material": 1})",
                             R"(}, "material": 2})", R"(}, "material": 0})"},
                            materials));
    REQUIRE(read.of_face.size() == 10);
    CHECK(read.corner_colors.empty());
    for (const std::size_t second : {0u, 1u}) {
        CHECK(colors_of(read, second) == plain({0, 0.5f, 1}));
        for (const std::size_t first : {2u, 4u, 6u}) CHECK(colors_of(read, first + second).empty());
        CHECK(colors_of(read, 8 + second) == plain({0.5f, 0.25f, 1}));
    }
    CHECK(materials_of(strips({"}}", R"(}, "material": 1})"}, materials)) == FaceMaterials{});
}

TEST_CASE(
    "glTF: vertices have linear colors of any type, times the material's, in every instance") {
    const std::string materials =
        R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1]}}])";
    // Triangles of a strip: 0 1 2, then 1 3 2.
    for (const std::string accessor : {"1", "2", "3"}) {
        CAPTURE(accessor);
        const std::string color = R"(, "COLOR_0": )" + accessor;
        const FaceMaterials read =
            materials_of(strips({"}}", color + "}}", color + R"(}, "material": 0})"}, materials));
        REQUIRE(read.of_face.size() == 6);
        CHECK(colors_of(read, 0).empty());
        CHECK(colors_of(read, 1).empty());
        const auto near = [](const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
            if (a.size() != b.size()) return false;
            for (std::size_t i = 0; i < a.size(); ++i)
                for (int c = 0; c < 3; ++c)
                    if (std::abs(a[i][c] - b[i][c]) > 1e-6f) return false;
            return true;
        };
        const bool has_floats = accessor == "1";
        const glm::vec3 b(0, has_floats ? 0.25f : 0.2f, 0), c(0, 0, has_floats ? 0.5f : 0.4f);
        const glm::vec3 d(1, 0, has_floats ? 0.75f : 1.0f);
        const glm::vec3 factor(0.5f, 1, 1);
        CHECK(near(colors_of(read, 2), {k_red, b, c}));
        CHECK(near(colors_of(read, 3), {b, d, c}));
        CHECK(near(colors_of(read, 4), {factor * k_red, b, c}));
        CHECK(near(colors_of(read, 5), {b, factor * d, c}));
    }
    // The second instance mirrors its triangles.
    const FaceMaterials twice = materials_of(gltf(
        R"("meshes": [{"primitives": [{"mode": 5, "attributes": {"POSITION": 0, "COLOR_0": 1}}]}],
           "nodes": [{"mesh": 0}, {"mesh": 0, "scale": [-1, 1, 1]}])"));
    REQUIRE(twice.of_face.size() == 4);
    const std::vector<glm::vec3> first = colors_of(twice, 0);
    CHECK(colors_of(twice, 2) == std::vector{first[0], first[2], first[1]});
}

TEST_CASE("glTF: colors whose numbers glTF does not allow are a warning, and missing") {
    // Bytes and shorts that are not normalized, and signed bytes that are.
    for (const auto& [color, found, numbers] :
         {std::array<std::string, 3>{"2", R"(5121, "normalized": true)", "5121"},
          {"3", R"(5123, "normalized": true)", "5123"},
          {"2", R"(5121, "normalized": true)", R"(5120, "normalized": true)"},
          {"3", R"(5123, "normalized": true)", R"(5122, "normalized": true)"}}) {
        CAPTURE(numbers);
        std::string document = strips({R"(, "COLOR_0": )" + color + "}}"});
        REQUIRE(materials_of(document).materials.size() == 1);
        document.replace(document.find(found), found.size(), numbers);
        const MeshSource source = read_text("a.gltf", document);
        CHECK(source.triangles.size() == 2);
        CHECK(source.materials.empty());
        REQUIRE(source.warnings.size() == 1);
        CHECK(has(source.warnings[0], "accessors[" + color + "]: holds colors, which should be"));
    }
}

TEST_CASE("glTF: faulty materials and colors are named") {
    const auto error = [](const std::string& document) { return error_of("a.gltf", document); };
    CHECK(has(error(strips({R"(}, "material": 1})"}, "[{}]")), "material 1 does not exist"));
    CHECK(has(error(strips({R"(}, "material": "red"})"}, "[{}]")), "primitives[0].material: "));
    CHECK(
        has(error(strips({"}}"}, R"([{"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1]}}])")),
            "materials[0].pbrMetallicRoughness.baseColorFactor: should have 4 numbers"));
    CHECK(has(error(strips({"}}"}, R"([{"pbrMetallicRoughness": 1}])")), "should be an object"));
    CHECK(has(error(strips({R"(, "COLOR_0": 4}})"})), "COLOR_0 has 3 colors for 4 vertices"));
    CHECK(has(error(strips({R"(, "COLOR_0": 5}})"})),
              "accessors[5]: should be of type VEC3 or VEC4"));
    CHECK(has(error(strips({R"(, "COLOR_0": 9}})"})), "accessors[9]: does not exist"));
}

TEST_CASE("files without colors have no materials and no warnings") {
    for (const SampleFile& file : sample_files()) {
        CAPTURE(file.name);
        const MeshSource source = read_text(file.name, file.bytes);
        CHECK(source.materials == FaceMaterials{});
        // The library of the OBJ is missing.
        CHECK(source.warnings.size() == (file.name == "sample.obj" ? 1 : 0));
    }
}

TEST_CASE("faces keep their colors when vertices are welded and faces are divided") {
    // Two squares on each other's vertices, of which a mesh has four.
    const MeshSource source = read_with_library(
        k_flat_square + k_flat_square +
        "mtllib colors.mtl\nusemtl red\nf 1 2 3 4\nusemtl gray\nf 5 6 7 8\nf 5 5 6\n");
    const Mesh mesh(source);
    CHECK(mesh.vertex_count() == 4);
    CHECK(mesh.materials() == source.materials);
    CHECK(Mesh(source, Welding::none).materials() == source.materials);
    const MeshSource fine = subdivide_loop(source, 2);
    REQUIRE(are_materials_of(fine.materials, fine.triangles.size()));
    for (std::size_t f = 0; f < fine.triangles.size(); ++f)
        CHECK(fine.materials.of_face[f] == source.materials.of_face[f / 16]);
}

TEST_CASE("damaged colors are an error, or those of the file, and damaged libraries are warnings") {
    const std::string obj =
        "mtllib colors.mtl\nv 0 0 0 1 0 0\nv 1 0 0 .5 1 0\nv 1 1 0\nusemtl red\nf 1 2 3\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
        "float z\n"
        "property float red\nproperty uchar green\nproperty int blue\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0 1 2 3\n1 0 0 .5 6 7\n1 1 0 -9 "
        "200 1\n3 0 1 2\n";
    const std::string document =
        strips({R"(, "COLOR_0": 1}})", R"(, "COLOR_0": 2}, "material": 0})"},
               R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1]}}])");
    const std::uint32_t seed = 3;
    CAPTURE(seed);
    std::mt19937 random(seed);
    const ScratchFolder folder;
    const auto check = [&](const std::string& name, const std::string& bytes) {
        try {
            const MeshSource source =
                read_mesh_file(folder.write(name, bytes), FaceRequirement::faces_or_points);
            CHECK(is_sound(source));
        } catch (const Error& e) {
            CHECK(has(e.what(), name + ":"));
        }
    };
    const auto for_each_damage = [&](const std::string& bytes, auto&& visit) {
        for (std::size_t size = 0; size < bytes.size(); ++size) visit(bytes.substr(0, size));
        for (int i = 0; i < 2000; ++i) {
            std::string damaged = bytes;
            damaged[random() % damaged.size()] = random() % 2
                                                     ? static_cast<char>(random())
                                                     : "0123456789-.,[]{}\" \nN"[random() % 21];
            visit(damaged);
        }
    };
    folder.write("colors.mtl", k_library);
    for_each_damage(obj, [&](const std::string& bytes) { check("a.obj", bytes); });
    for_each_damage(ply, [&](const std::string& bytes) { check("a.ply", bytes); });
    for_each_damage(document, [&](const std::string& bytes) { check("a.gltf", bytes); });
    for_each_damage(k_library, [&](const std::string& bytes) {
        folder.write("colors.mtl", bytes);
        CHECK(is_sound(read_mesh_file(folder.write("a.obj", obj))));
    });
}

TEST_CASE("PLY: all triangles of a face have its color, before or after the vertices") {
    const std::string head = "ply\nformat ascii 1.0\n";
    const std::string vertex =
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    // A color on either side of the indices.
    const std::string face =
        "element face 2\nproperty uchar red\nproperty list uchar int vertex_indices\n"
        "property uchar green\nproperty uchar blue\n";
    const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const std::string faces = "255 4 0 1 2 3 0 0\n0 3 0 1 2 255 0\n";
    const glm::vec3 green(0, 1, 0);
    for (const std::string& text : {head + vertex + face + "end_header\n" + vertices + faces,
                                    head + face + vertex + "end_header\n" + faces + vertices}) {
        const MeshSource source = read_text("a.ply", text);
        REQUIRE(source.triangles.size() == 3);
        REQUIRE(are_materials_of(source.materials, 3));
        CHECK(colors_of(source.materials, 0) == plain(k_red));
        CHECK(colors_of(source.materials, 1) == plain(k_red));
        CHECK(colors_of(source.materials, 2) == plain(green));
    }
}

TEST_CASE("PLY: colors of faces and vertices are multiplied, and strips stay white") {
    const MeshSource source = read_text(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element tristrips 1\nproperty list int int vertex_indices\n"
        "element face 1\nproperty list uchar int vertex_indices\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nend_header\n"
        "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 255 255 255\n3 0 1 2\n3 0 1 2 255 0 0\n");
    REQUIRE(source.triangles.size() == 2);
    const glm::vec3 black(0.0f), white(1.0f), green(0, 1, 0);
    CHECK(colors_of(source.materials, 0) == std::vector<glm::vec3>{k_red, green, white});
    CHECK(colors_of(source.materials, 1) == std::vector<glm::vec3>{k_red, black, k_red});
}
