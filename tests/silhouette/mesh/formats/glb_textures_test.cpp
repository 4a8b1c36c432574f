#include "silhouette/mesh/formats/glb_textures.h"

#include "silhouette/mesh/formats/embed_textures.h"
#include "silhouette/mesh/formats/glb_writer.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/formats/read_colors.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

const std::string k_png_begin = "\x89PNG\r\n\x1a\n";

/// A ball whose faces have one of three textured materials, one without a texture, or none, in turn. Two of the
/// textures have the same file; the other file is damaged.
MeshSource textured_ball(const ScratchFolder& folder) {
    MeshSource source = make_built_in_shape("sphere", 500);
    const std::vector<std::byte> png = encode_png({1, 1, {255, 0, 0, 255}});
    const auto first =
        folder.write("a.png", {reinterpret_cast<const char*>(png.data()), png.size()});
    const auto second = folder.write("b.jpg", "\xff\xd8\xffsecond");
    FaceMaterials& materials = source.materials;
    materials.textures = {
        {.place = "a", .path = first, .wrap_u = TextureWrap::clamp, .is_pixelated = true},
        {.place = "b", .path = second, .wrap_v = TextureWrap::mirror},
        {.place = "c", .path = first},
        {.place = "not used", .path = folder.path() / "gone.png"}};
    materials.materials = {{.texture = TextureId{0}},
                           {.base_color = glm::vec3(0.5f), .texture = TextureId{1}},
                           {.texture = TextureId{2}},
                           {.base_color = glm::vec3(0.25f)},
                           {.texture = TextureId{3}}};
    for (std::size_t f = 0; f < source.triangles.size(); ++f) {
        materials.of_face.push_back(f % 5 == 4 ? k_no_material : MaterialId(f % 5));
        for (int c = 0; c < 3; ++c)
            materials.corner_uvs.emplace_back(0.001f * float(f), 0.1f * float(c));
    }
    return source;
}

}  // namespace

TEST_CASE("GLB: textures are kept with the bytes of their files and with their coordinates") {
    for (const bool has_colors : {false, true}) {
        const ScratchFolder folder;
        MeshSource source = textured_ball(folder);
        if (has_colors)
            for (std::size_t corner = 0; corner < 3 * source.triangles.size(); ++corner)
                source.materials.corner_colors.emplace_back(0.0001f * float(corner));
        embed_textures(source);
        REQUIRE(source.warnings.size() == 1);
        CHECK(has(source.warnings[0], "b: "));
        CHECK(has(source.warnings[0], "b.jpg: "));
        CHECK(has(source.warnings[0], "; it is copied as it is"));
        const Mesh mesh(source);
        const MeshSource read = read_text("a.glb", glb_bytes(mesh, {}));
        CHECK(read.warnings.empty());
        REQUIRE(tests::is_sound(read));
        CHECK(Mesh(read).vertex_count() == mesh.vertex_count());
        std::vector<std::uint32_t> order;
        for (std::uint32_t group = 0; group < 5; ++group)
            for (std::uint32_t f = group; f < mesh.face_count(); f += 5) order.push_back(f);
        REQUIRE(order.size() == read.triangles.size());
        bool are_equal = true;
        for (std::uint32_t f = 0; f < order.size(); ++f) {
            are_equal &= colors_of(read.materials, f) == colors_of(mesh.materials(), order[f]);
            const TextureId own = mesh.materials().texture_of(order[f]);
            const TextureId found = read.materials.texture_of(f);
            are_equal &= (own == k_no_texture) == (found == k_no_texture);
            if (own == k_no_texture || found == k_no_texture) continue;
            const MaterialTexture& a = mesh.materials().textures[index(own)];
            const MaterialTexture& b = read.materials.textures[index(found)];
            are_equal &= *a.embedded == *b.embedded && a.wrap_u == b.wrap_u &&
                         a.wrap_v == b.wrap_v && a.is_pixelated == b.is_pixelated;
            for (std::size_t c = 0; c < 3; ++c)
                are_equal &= mesh.materials().corner_uvs[3 * order[f] + c] ==
                             read.materials.corner_uvs[3 * f + c];
        }
        CHECK(are_equal);
    }
}

TEST_CASE("GLB: a picture of several textures is written once") {
    const ScratchFolder folder;
    MeshSource source = textured_ball(folder);
    embed_textures(source);
    const std::string glb = glb_bytes(Mesh(source), {});
    const std::size_t at = glb.find(k_png_begin);
    REQUIRE(at != std::string::npos);
    CHECK(glb.find(k_png_begin, at + 1) == std::string::npos);
}

TEST_CASE("GLB: a texture that cannot be written is a warning and its faces keep their color") {
    const ScratchFolder folder;
    MeshSource source = textured_ball(folder);
    folder.write("a.png", "GIF89a");
    std::filesystem::remove(folder.path() / "b.jpg");
    embed_textures(source);
    REQUIRE(source.warnings.size() == 2);
    CHECK(has(source.warnings[0], "a: "));
    CHECK(has(source.warnings[0], "a.png: it is neither PNG nor JPEG; the texture is missing"));
    CHECK(has(source.warnings[1], "b: "));
    CHECK(has(source.warnings[1], "b.jpg"));
    const Mesh mesh(source);
    const std::string glb = glb_bytes(mesh, {});
    for (const char* word : {"TEXCOORD_0", "images", "samplers", "textures"})
        CHECK(!has(glb, word));
    const MeshSource read = read_text("a.glb", glb);
    // Of the second material, after the faces of the first.
    CHECK(colors_of(read.materials, (mesh.face_count() + 4) / 5) == plain(glm::vec3(0.5f)));
}

TEST_CASE("embed_textures: a file in place of a picture is told") {
    const ScratchFolder folder;
    MeshSource source = textured_ball(folder);
    folder.write("a.png", "version https://git-lfs.github.com/spec/v1\n");
    embed_textures(source);
    REQUIRE(source.warnings.size() == 2);
    CHECK(has(source.warnings[0], "a.png: it is a pointer of Git LFS; 'git lfs pull'"));
}

TEST_CASE("embed_textures: the first bytes say the type of a picture") {
    CHECK(picture_mime_type(k_png_begin) == std::string("image/png"));
    CHECK(picture_mime_type("\xff\xd8\xff\xe0") == std::string("image/jpeg"));
    for (const std::string bytes : {"", "\x89PNG", "\xff\xd8", "RIFF1234WEBP"})
        CHECK(picture_mime_type(bytes) == nullptr);
}
