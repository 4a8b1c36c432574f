#include "silhouette/mesh/formats/off_colors.h"

#include <random>

#include "silhouette/srgb.h"
#include "tests/silhouette/mesh/formats/read_colors.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

/// A square of two triangles. `ends` end the lines of its vertices or faces.
std::string off_square(const std::string& word, const std::vector<std::string>& vertex_ends,
                       const std::vector<std::string>& face_ends) {
    const std::vector<std::string> points{"0 0 0", "1 0 0", "1 1 0", "0 1 0"};
    const std::vector<std::string> faces{"3 0 1 2", "3 0 2 3"};
    std::string text = word + "\n4 2 0\n";
    for (std::size_t i = 0; i < 4; ++i)
        text += points[i] + " " + vertex_ends[i % vertex_ends.size()] + "\n";
    for (std::size_t i = 0; i < 2; ++i)
        text += faces[i] + " " + face_ends[i % face_ends.size()] + "\n";
    return text;
}

FaceMaterials off_materials(const std::string& text) {
    const MeshSource source = read_text("a.off", text);
    CHECK(source.warnings.empty());
    REQUIRE(are_materials_of(source.materials, source.triangles.size()));
    return source.materials;
}

const glm::vec3 k_off_red(1, 0, 0);
const glm::vec3 k_off_fifth = linear_from_srgb(glm::vec3(51.0f / 255.0f));

bool are_near(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    return std::ranges::equal(a, b, [](const glm::vec3& x, const glm::vec3& y) {
        return std::abs(x.x - y.x) + std::abs(x.y - y.y) + std::abs(x.z - y.z) < 1e-6f;
    });
}

}  // namespace

TEST_CASE("OFF: vertices have colors of integers up to 255 or of numbers up to 1") {
    for (const auto& [red, gray] : {std::pair<std::string, std::string>{"255 0 0", "51 51 51"},
                                    {"255 0 0 255", "51 51 51 255"},
                                    {"1.0 0.0 0.0", "0.2 0.2 0.2"},
                                    {"1 0 0", "0.2 0.2 0.2"},  // As C++ writes 1.0.
                                    {"1 0 0 1", "2e-1 .2 0.2 1"},
                                    {"1.0000002 0 0.0 1", "0.2 0.2 0.2 0.5"},
                                    {"255.0 0.0 0.0", "51.0 51.0 51.0"},
                                    {"1.0 0.0 0.0 255", "0.2 0.2 0.2 255"}}) {
        CAPTURE(red);
        for (const auto& [word, before, after] : {std::array<std::string, 3>{"COFF", "", ""},
                                                  {"CNOFF", "0 0 1 ", ""},
                                                  {"STCNOFF", "0 0 1 ", " 0.5 0.5"},
                                                  {"NCOFF", "", " 0 0 1"},
                                                  {"CSTOFF", "", " 0 1"}}) {
            CAPTURE(word);
            const FaceMaterials read = off_materials(
                off_square(word, {before + red + after, before + gray + after}, {""}));
            CHECK(are_near(colors_of(read, 0), {k_off_red, k_off_fifth, k_off_red}));
            CHECK(are_near(colors_of(read, 1), {k_off_red, k_off_red, k_off_fifth}));
        }
    }
}

TEST_CASE("OFF: faces have the color that ends their line and all triangles of a polygon have it") {
    for (const std::string red :
         {"255 0 0", "255 0 0 128", "1.0 0.0 0.0", "1.0 0 0 0.5", "1 0 0"}) {
        CAPTURE(red);
        const FaceMaterials read = off_materials(off_square("OFF", {""}, {"", red + " # red"}));
        CHECK(colors_of(read, 0).empty());
        CHECK(colors_of(read, 1) == plain(k_off_red));
    }
    const FaceMaterials read = off_materials(
        "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 51 51 51\n3 0 1 2\n3 0 2 3 1.0 0.0 "
        "0.0\n");
    CHECK(are_near(colors_of(read, 0), plain(k_off_fifth)));
    CHECK(colors_of(read, 1) == colors_of(read, 0));
    CHECK(colors_of(read, 2).empty());
    CHECK(colors_of(read, 3) == plain(k_off_red));
    CHECK(off_materials(off_square("OFF", {""}, {""})).empty());
}

TEST_CASE("OFF: colors of vertices and of faces are multiplied, each in its own range") {
    const FaceMaterials read = off_materials(off_square("COFF", {"51 51 51 255"}, {"1 0 0", ""}));
    CHECK(are_near(colors_of(read, 0), plain(k_off_fifth * k_off_red)));
    CHECK(are_near(colors_of(read, 1), plain(k_off_fifth)));
}

TEST_CASE("OFF: an index of a colormap is one warning and no color") {
    const MeshSource source = read_text("a.off", off_square("OFF", {""}, {"7", "-1"}));
    CHECK(source.materials.empty());
    REQUIRE(source.warnings.size() == 1);
    CHECK(has(source.warnings[0], "a.off:7: '7' after a face is an index of a colormap"));
    const MeshSource mixed = read_text("a.off", off_square("OFF", {""}, {"7", "255 0 0"}));
    CHECK(mixed.warnings.size() == 1);
    CHECK(colors_of(mixed.materials, 0).empty());
    CHECK(colors_of(mixed.materials, 1) == plain(k_off_red));
}

TEST_CASE("OFF: what is no color is a warning with its line, and a word an error") {
    const auto face = [](const std::string& end) {
        return error_of("a.off", off_square("OFF", {""}, {"", end}));
    };
    const auto vertex = [](const std::string& end) {
        return error_of("a.off", off_square("COFF", {"0 0 0", end}, {""}));
    };
    CHECK(face("255 0 0").empty());
    CHECK(has(face("255 red 0"), "a.off:8: 'red' is not a number; a face's color should"));
    const auto warning = [](const std::string& kind, const std::string& vertex_end,
                            const std::string& face_end) {
        const bool has_vertices = kind == "COFF";
        const MeshSource source = read_text(
            "a.off",
            off_square(kind, {has_vertices ? "0 0 9" : "", vertex_end}, {"0 0 9", face_end}));
        REQUIRE(source.warnings.size() == 1);
        CHECK(colors_of(source.materials, 0).size() == 3);
        for (const glm::vec3& color : source.materials.corner_colors)
            CHECK(std::min({color.x, color.y, color.z}) >= 0.0f);
        return source.warnings.front();
    };
    CHECK(has(warning("OFF", "", "255 0"), "a.off:8: a face's color has 2 numbers, not 3 or 4"));
    for (const char* channel : {"256", "-1", "nan", "1e999"})
        CHECK(
            has(warning("OFF", "", std::string("0 ") + channel + " 0 9"),
                std::string("a.off:8: a face's color has a channel '") + channel + "', which is"));
    for (const char* alpha : {"-1", "nan", "inf", "999"})
        CHECK(read_text("a.off", off_square("OFF", {""}, {"", std::string("1 0 0 ") + alpha}))
                  .warnings.empty());
    CHECK(
        has(warning("COFF", "0 300 0", "0 0 9"), "a.off:4: a vertex's color has a channel '300'"));
    CHECK(has(face("1 0 0 0 0"), "a.off:8: '0' after a face"));
    CHECK(has(face("x"), "a.off:8: 'x' is not a number"));
    CHECK(vertex("9 9 9").empty());
    CHECK(has(vertex("9 9 x"), "a.off:4: 'x' is not a number; a vertex's color should"));
}

TEST_CASE("OFF: damaged colored files are an error or sound") {
    const std::uint32_t seed = 7;
    CAPTURE(seed);
    std::mt19937 random(seed);
    const ScratchFolder folder;
    const auto check = [&](const std::string& bytes) {
        try {
            const MeshSource source =
                read_mesh_file(folder.write("a.off", bytes), FaceRequirement::faces_or_points);
            CHECK(tests::is_sound(source));
        } catch (const Error& e) {
            CHECK(has(e.what(), "a.off:"));
        }
    };
    for (const std::string& whole :
         {off_square("COFF", {"1 0.5 0", "255 0 9 1"}, {"255 0 1", "0.5 0.5 1e0 1"}),
          off_square("NCOFF", {"9 9 9 9 0 0 1"}, {"3", ""})}) {
        for (std::size_t size = 0; size < whole.size(); ++size) check(whole.substr(0, size));
        for (int i = 0; i < 1000; ++i) {
            std::string damaged = whole;
            damaged[random() % damaged.size()] = "0123456789-.eEnaif \nN"[random() % 21];
            check(damaged);
        }
    }
}
