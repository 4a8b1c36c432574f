#include "silhouette/mesh/face_bits.h"

#include <doctest/doctest.h>
#include <algorithm>

#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

// For each of the 2^faces patterns of bits, whether the edge is on the silhouette by `rule` of how
// many of its faces are front.
template <typename Rule>
void check_all_patterns(const Mesh& mesh, EdgeId edge, Rule&& rule) {
    for (std::uint32_t pattern = 0; pattern < 1u << mesh.face_count(); ++pattern) {
        CAPTURE(pattern);
        const std::uint32_t words[] = {pattern};
        const auto faces = mesh.faces_of(edge);
        const auto front = std::count_if(faces.begin(), faces.end(), [&](FaceId face) {
            return (pattern >> index(face) & 1u) != 0;
        });
        CHECK(is_on_silhouette(mesh, edge, words) == rule(front, std::ssize(faces)));
    }
}

}  // namespace

TEST_CASE("there are as many words as 32 bits each need") {
    CHECK(face_word_count(0) == 0);
    CHECK(face_word_count(1) == 1);
    CHECK(face_word_count(32) == 1);
    CHECK(face_word_count(33) == 2);
    CHECK(face_word_count(1u << 30) == 1u << 25);
}

TEST_CASE("face f is bit f mod 32 of word f / 32") {
    for (std::uint32_t set = 0; set < 96; ++set) {
        std::uint32_t words[3] = {};
        words[set / 32] = 1u << set % 32;
        for (std::uint32_t f = 0; f < 96; ++f) CHECK(face_bit(words, FaceId{f}) == (f == set));
    }
}

TEST_CASE("a regular edge is on the silhouette when its faces' bits differ") {
    const Mesh mesh(tests::tetrahedron());
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        check_all_patterns(mesh, EdgeId{e}, [](auto front, auto) { return front == 1; });
}

TEST_CASE("an inconsistent edge is on the silhouette when its faces' bits are equal") {
    const Mesh mesh(tests::band(4, true));
    const Mesh::EdgeRange range = mesh.edges_of_class(EdgeClass::inconsistent);
    REQUIRE(range.size() == 1);
    check_all_patterns(mesh, EdgeId{range.first}, [](auto front, auto) { return front != 1; });
}

TEST_CASE("a non-manifold edge is on the silhouette when its faces' bits are not all equal") {
    for (const std::uint32_t wings : {3u, 4u, 7u}) {
        const Mesh mesh(tests::book(wings));
        const Mesh::EdgeRange range = mesh.edges_of_class(EdgeClass::nonmanifold);
        REQUIRE(range.size() == 1);
        check_all_patterns(mesh, EdgeId{range.first},
                           [](auto front, auto count) { return front > 0 && front < count; });
    }
}

TEST_CASE("a border is never on the silhouette") {
    const Mesh mesh(tests::book(3));
    const Mesh::EdgeRange range = mesh.edges_of_class(EdgeClass::border);
    REQUIRE(range.size() == 6);
    for (std::uint32_t e = range.first; e < range.last; ++e)
        check_all_patterns(mesh, EdgeId{e}, [](auto, auto) { return false; });
}

}  // namespace rimline
