#include "silhouette/mesh/face_pairs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/mesh/face_stars.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/solid.h"
#include "tests/rounds.h"
#include "tests/silhouette/hough/support/instruction_sets.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// Each with the lower face first, ascending.
Pairs near_pairs(const Mesh& mesh) {
    std::mutex mutex;
    Pairs pairs;
    CHECK(each_near_face_pair(mesh, FaceTree(mesh), [&](std::span<const FacePair> some) {
        const std::lock_guard lock(mutex);
        for (const FacePair& pair : some)
            pairs.emplace_back(std::min(pair.a, pair.b), std::max(pair.a, pair.b));
        return true;
    }));
    std::ranges::sort(pairs);
    return pairs;
}

// Faces with corners on a small grid, so that many touch, overlap, share corners or have no area.
MeshSource grid_soup(tests::Random& random, int faces, int cells) {
    MeshSource source;
    for (int z = 0; z < cells; ++z)
        for (int y = 0; y < cells; ++y)
            for (int x = 0; x < cells; ++x) source.positions.push_back(glm::vec3(x, y, z));
    const auto corners = static_cast<std::uint32_t>(source.positions.size());
    for (int f = 0; f < faces; ++f)
        source.triangles.push_back(
            {random.below(corners), random.below(corners), random.below(corners)});
    return source;
}

using GridFace = std::array<glm::ivec3, 3>;

int sign_of(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c, const glm::ivec3& d) {
    const glm::ivec3 u = b - a, v = c - a, w = d - a;
    const int volume = w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) +
                       w.z * (u.x * v.y - u.y * v.x);
    return (volume > 0) - (volume < 0);
}

bool is_corner(const GridFace& face, const glm::ivec3& p) {
    return std::ranges::find(face, p) != face.end();
}

bool boxes_meet(const GridFace& a, const GridFace& b) {
    for (int i = 0; i < 3; ++i) {
        const auto along = [i](const glm::ivec3& p) { return p[i]; };
        if (along(std::ranges::max(a, {}, along)) < along(std::ranges::min(b, {}, along)) ||
            along(std::ranges::max(b, {}, along)) < along(std::ranges::min(a, {}, along)))
            return false;
    }
    return true;
}

// Whether all corners of `b` that are not corners of `a` lie strictly on one side of its plane.
bool is_beside(const GridFace& a, const GridFace& b) {
    bool has_left = false, has_right = false;
    for (const glm::ivec3& p : b) {
        if (is_corner(a, p)) continue;
        const int side = sign_of(a[0], a[1], a[2], p);
        if (side == 0) return false;
        (side > 0 ? has_left : has_right) = true;
    }
    return has_left != has_right;
}

// Whether each side of `a` that crosses the plane of `b` passes it strictly outside, and no other corner is on it. Not
// where all corners are shared.
bool passes_by(const GridFace& a, const GridFace& b) {
    if (is_corner(b, a[0]) && is_corner(b, a[1]) && is_corner(b, a[2])) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (!is_corner(b, a[k]) && sign_of(b[0], b[1], b[2], a[k]) == 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::ivec3 &p = a[k], &q = a[(k + 1) % 3];
        if (is_corner(b, p) || is_corner(b, q) ||
            sign_of(b[0], b[1], b[2], p) == sign_of(b[0], b[1], b[2], q))
            continue;
        bool has_left = false, has_right = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const int turn = sign_of(p, q, b[i], b[(i + 1) % 3]);
            has_left |= turn > 0, has_right |= turn < 0;
        }
        if (!has_left || !has_right) return false;
    }
    return true;
}

// By integers, which the floats are; but for what face_stars_test.cpp tests.
Pairs expected_pairs(const Mesh& mesh) {
    std::vector<GridFace> corners(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            corners[f][k] = glm::ivec3(mesh.positions()[index(mesh.triangles()[f][k])]);
    Pairs pairs;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t g = f + 1; g < mesh.face_count(); ++g) {
            const GridFace &a = corners[f], &b = corners[g];
            if (boxes_meet(a, b) && !is_beside(a, b) && !is_beside(b, a) &&
                !(passes_by(a, b) && passes_by(b, a)) && !meet_in_corner_only(mesh, f, g))
                pairs.emplace_back(f, g);
        }
    return pairs;
}

TEST_CASE("on every instruction set the pairs of a soup are those that integers find") {
    tests::Random random(5);
    for (int round = 0; round < 30; ++round) {
        CAPTURE(round);
        const Mesh mesh(grid_soup(random, 10 + 10 * round, round % 2 == 0 ? 4 : 12));
        const Pairs expected = expected_pairs(mesh);
        CHECK(!expected.empty());
        tests::for_each_instruction_set([&](const std::string& name) {
            CAPTURE(name);
            CHECK(near_pairs(mesh) == expected);
        });
    }
}

TEST_CASE("a soup that all threads share has each pair once and the same in every run" *
          doctest::test_suite("threads")) {
    tests::Random random(7);
    const Mesh mesh(grid_soup(random, 1500, 30));
    const Pairs first = near_pairs(mesh);
    CHECK(first.size() > 1000);
    CHECK(std::ranges::adjacent_find(first) == first.end());
    for (int run = 0; run < tests::rounds(3); ++run) CHECK(near_pairs(mesh) == first);
}

TEST_CASE("a curved surface has no pairs that may meet, at any scale") {
    for (const float scale : {1.0f, 0x1p-70f, 0x1p50f}) {
        MeshSource source = make_built_in_shape("sphere", 3000);
        for (glm::vec3& p : source.positions) p *= scale;
        CHECK(near_pairs(Mesh(source)).empty());
    }
    CHECK(near_pairs(Mesh(MeshSource{})).empty());
    CHECK(near_pairs(Mesh(tests::tetrahedron())).empty());
}

TEST_CASE("faces that are there twice may meet elsewhere") {
    const MeshSource source{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    CHECK(near_pairs(Mesh(source)) == Pairs{{0, 1}});
}

TEST_CASE("the smallest meshes have the pairs of larger ones") {
    MeshSource both = tests::octahedron();
    const MeshSource other = tests::octahedron();
    for (const glm::vec3& p : other.positions) both.positions.push_back(p + glm::vec3(0.5f, 0, 0));
    for (const auto& t : other.triangles) both.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
    const Pairs expected = near_pairs(Mesh(both));
    CHECK(expected.size() > 4);
    for (const int exponent : {-100, -126, -130, -135, -140}) {
        CAPTURE(exponent);
        MeshSource small = both;
        for (glm::vec3& p : small.positions) p *= std::exp2(static_cast<float>(exponent));
        const Mesh mesh(small);
        const Pairs found = near_pairs(mesh);
        CHECK(std::ranges::includes(found, expected));
        for (const auto& [a, b] : found) CHECK(std::max(a, b) < mesh.face_count());
        CHECK_FALSE(is_solid(mesh));
    }
}

TEST_CASE(
    "a search ends where it is told to, where it has too many pairs, and where it is cancelled") {
    tests::Random random(6);
    const Mesh mesh(grid_soup(random, 500, 5));
    const FaceTree tree(mesh);
    const auto take = [](std::span<const FacePair>) { return true; };
    CHECK(each_near_face_pair(mesh, tree, take));
    CHECK_FALSE(each_near_face_pair(mesh, tree, [](std::span<const FacePair>) { return false; }));
    // The boxes of all pairs that are found meet, and those of no more than all pairs.
    CHECK_FALSE(each_near_face_pair(mesh, tree, take, {}, near_pairs(mesh).size() - 1));
    CHECK(each_near_face_pair(mesh, tree, take, {}, 500 * 499 / 2));
    // One face, and two apart: no pairs. Two that share a corner: one.
    const auto goes_on = [&](const MeshSource& source, std::uint64_t max_pairs) {
        const Mesh some(source);
        return each_near_face_pair(some, FaceTree(some), take, {}, max_pairs);
    };
    CHECK(goes_on({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 0));
    const MeshSource two{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
                         {{0, 1, 2}, {1, 3, 4}}};
    CHECK_FALSE(goes_on(two, 0));
    CHECK(goes_on(two, 1));
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(each_near_face_pair(mesh, tree, take, {stop.get_token(), {}}), Error);
}

}  // namespace
}  // namespace rimline
