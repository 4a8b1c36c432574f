#include "silhouette/mesh/formats/stl_colors.h"

#include <random>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/srgb.h"
#include "tests/silhouette/mesh/formats/read_colors.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

/// The sample with these attributes of its five facets.
MeshSource read_stl_with(std::string header, const std::vector<unsigned>& attributes) {
    header.resize(80, ' ');
    std::string bytes = sample_stl_binary(header);
    for (std::size_t f = 0; f < 5; ++f) {
        bytes[84 + 50 * f + 48] = static_cast<char>(attributes[f] & 0xff);
        bytes[84 + 50 * f + 49] = static_cast<char>(attributes[f] >> 8);
    }
    MeshSource source = read_text("a.stl", bytes);
    CHECK(tests::is_sound(source));
    CHECK(source.positions == sample_soup());
    return source;
}

std::vector<glm::vec3> stl_colors_of(const std::string& header,
                                     const std::vector<unsigned>& attributes) {
    const MeshSource source = read_stl_with(header, attributes);
    CHECK(source.warnings.empty());
    std::vector<glm::vec3> colors;
    for (std::size_t f = 0; f < 5; ++f) {
        const std::vector<glm::vec3> corners = colors_of(source.materials, f);
        CHECK(corners ==
              std::vector<glm::vec3>(corners.size(), corners.empty() ? glm::vec3() : corners[0]));
        colors.push_back(corners.empty() ? k_no_color : corners[0]);
    }
    return colors;
}

using Five = std::vector<glm::vec3>;

const glm::vec3 k_first(1, 0, 0);  // Of the highest or the lowest bits.
const glm::vec3 k_last(0, 0, 1);
const glm::vec3 k_mixed = linear_from_srgb({1.0f / 31.0f, 2.0f / 31.0f, 3.0f / 31.0f});
constexpr unsigned k_high = 31 << 10, k_low = 31, k_123 = 1 << 10 | 2 << 5 | 3,
                   k_321 = 3 << 10 | 2 << 5 | 1;
// Teal, in Magics' header; 51 of 255 is a fifth.
const std::string k_magics = std::string("COLOR=") + "\x33\xff\xff\xff" + ",MATERIAL=";
const glm::vec3 k_teal = linear_from_srgb({51.0f / 255.0f, 1, 1});

}  // namespace

TEST_CASE("STL: facets whose bit 15 is set have colors with red in the highest bits") {
    CHECK(stl_colors_of("VisCAM", {0x8000 | k_high, 0x8000 | k_low, 0, 0x8000, 0x8000 | k_123}) ==
          Five{k_first, k_last, k_no_color, glm::vec3(0), k_mixed});
    CHECK(stl_colors_of("", {0xffff, 0xffff, 0xffff, 0xffff, 0xffff}) == Five(5, glm::vec3(1)));
}

TEST_CASE("STL: without colors in its attributes a file has no materials") {
    CHECK(read_stl_with("", {0, 0, 0, 0, 0}).materials.empty());
    // Numbers of parts, say.
    const MeshSource numbered = read_stl_with("", {1, 2, 3, 4, 0x7fff});
    CHECK(numbered.materials.empty());
    CHECK(numbered.warnings.empty());
    CHECK(read_stl_with("COLOR", {1, 2, 3, 4, 5}).materials.empty());
    // The color would end beyond the header.
    CHECK(read_stl_with(std::string(71, ' ') + "COLOR=\x33\xff\xff", {1, 2, 3, 4, 5})
              .materials.empty());
}

TEST_CASE("STL: attributes that contradict each other are no colors and a warning says which") {
    const MeshSource source = read_stl_with("", {0, 0x8001, 0, 7, 0xffff});
    CHECK(source.materials.empty());
    REQUIRE(source.warnings.size() == 1);
    CHECK(
        has(source.warnings[0],
            "a.stl: the attributes of its facets are not read as colors: facet 1 has 32769, which "
            "would be one, but facet 3 has 7"));
}

TEST_CASE("STL: with COLOR= in the header red is in the lowest bits and bit 15 names its color") {
    for (const std::string before : {"", "exported by X "}) {
        CHECK(stl_colors_of(before + k_magics, {k_high, k_low, 0x8000, 0xffff, k_321}) ==
              Five{k_last, k_first, k_teal, k_teal, k_mixed});
        for (const unsigned attribute : {0u, 0x8000u, 0xffffu})
            CHECK(stl_colors_of(before + k_magics, std::vector<unsigned>(5, attribute)) ==
                  Five(5, k_teal));
    }
    CHECK(stl_colors_of(std::string(70, ' ') + k_magics, std::vector<unsigned>(5, 0)) ==
          Five(5, k_teal));
}

TEST_CASE("STL: MeshLab sets bit 15 of all facets that have a color") {
    const std::string header = "COLOR=\x7f\x7f\x7f MATERIAL=\x7f\x7f\x7f \x7f\x7f\x7f \x7f\x7f\x7f";
    CHECK(
        stl_colors_of(header, {0x8000 | k_low, 0x8000 | k_high, 0xffff, 0x8000, 0x8000 | k_321}) ==
        Five{k_first, k_last, glm::vec3(1), glm::vec3(0), k_mixed});
    CHECK(stl_colors_of(header, std::vector<unsigned>(5, 0x8000 | k_low)) == Five(5, k_first));
}

TEST_CASE("STL: random attributes are no colors") {
    std::mt19937 random(11);
    std::string header(80, ' ');
    for (int round = 0; round < 200; ++round) {
        std::vector<std::uint16_t> attributes(40);
        for (std::uint16_t& a : attributes) a = static_cast<std::uint16_t>(random());
        const StlColors found = stl_colors(header, attributes);
        CHECK(found.colors.empty());
        CHECK(!found.warning.empty());
    }
    CHECK(stl_colors(header, {}).colors.empty());
    CHECK(stl_colors(k_magics + std::string(70, ' '), {}).colors.empty());
}
