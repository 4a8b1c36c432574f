#include "silhouette/mesh/face_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "silhouette/mesh/face_tree_segments.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using tests::Random;

// In several calls.
std::vector<FaceTree::NodePair> node_pairs(const FaceTree& tree, std::uint32_t max_faces) {
    FaceTree::NodePairs walk(tree, max_faces);
    std::vector<FaceTree::NodePair> all, some;
    double done = 0.0;
    do {
        walk.next(3, some);
        CHECK(walk.done() >= done);
        done = walk.done();
        all.insert(all.end(), some.begin(), some.end());
    } while (!some.empty());
    CHECK(done == doctest::Approx(1.0));
    return all;
}

// Small faces in a cube, some of them at the same place.
Mesh scattered_faces(Random& random, std::uint32_t faces) {
    MeshSource source;
    for (std::uint32_t f = 0; f < faces; ++f) {
        const glm::vec3 center = f % 5 == 4 ? source.positions.back() : random.in_cube();
        for (int k = 0; k < 3; ++k) source.positions.push_back(center + 0.2f * random.in_cube());
        source.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    return Mesh(source);
}

TEST_CASE("the order of a tree has each face once, and its leaves and blocks are full") {
    Random random(1);
    for (std::uint32_t faces = 0; faces < 300; faces += 1 + faces / 40) {
        CAPTURE(faces);
        const Mesh mesh = scattered_faces(random, faces);
        const FaceTree tree(mesh);
        std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
        std::ranges::sort(order);
        for (std::uint32_t f = 0; f < faces; ++f) CHECK(order[f] == f);
        std::vector<std::uint32_t> blocks;
        for (const FaceTree::NodePair& pair : node_pairs(tree, 64))
            tree.each_block_pair(pair, [&](const FaceTree::Node& a, const FaceTree::Node& b) {
                if (a.number == b.number) blocks.push_back(a.block());
                CHECK(a.size() == std::min(FaceTree::k_block_faces, faces - a.first));
                CHECK(a.first % FaceTree::k_block_faces == 0);
            });
        std::ranges::sort(blocks);
        for (std::uint32_t i = 0; i < blocks.size(); ++i) CHECK(blocks[i] == i);
        CHECK(blocks.size() ==
              std::max(1u, (faces + FaceTree::k_block_faces - 1) / FaceTree::k_block_faces));
    }
}

TEST_CASE("a tree finds the faces whose boxes meet a box, in its order") {
    Random random(2);
    for (const std::uint32_t faces : {0u, 1u, 4u, 5u, 16u, 17u, 33u, 100u, 5000u}) {
        CAPTURE(faces);
        const Mesh mesh = scattered_faces(random, faces);
        const FaceTree tree(mesh);
        for (int round = 0; round < 20; ++round) {
            const glm::vec3 center = random.in_cube(), reach = 0.3f * (random.in_cube() + 1.0f);
            const FaceBox box{center - reach, center + reach};
            std::vector<std::uint32_t> expected, found;
            for (std::uint32_t i = 0; i < faces; ++i)
                if (tree.box_of(tree.order()[i]).meets(box)) expected.push_back(tree.order()[i]);
            CHECK_FALSE(tree.any_meeting(box, [&](std::uint32_t face) {
                found.push_back(face);
                return false;
            }));
            CHECK(found == expected);
        }
    }
}

TEST_CASE("pairs of blocks hold each pair of faces whose boxes meet, once") {
    Random random(3);
    for (const std::uint32_t faces : {1u, 15u, 16u, 17u, 40u, 700u}) {
        CAPTURE(faces);
        const Mesh mesh = scattered_faces(random, faces);
        const FaceTree tree(mesh);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
        const auto add = [&](auto& pairs, std::uint32_t i, std::uint32_t j) {
            if (tree.box_of(tree.order()[i]).meets(tree.box_of(tree.order()[j])))
                pairs.emplace_back(std::min(i, j), std::max(i, j));
        };
        for (std::uint32_t i = 0; i < faces; ++i)
            for (std::uint32_t j = i + 1; j < faces; ++j) add(expected, i, j);
        for (const FaceTree::NodePair& pair : node_pairs(tree, 100))
            tree.each_block_pair(pair, [&](const FaceTree::Node& a, const FaceTree::Node& b) {
                for (std::uint32_t i = a.first; i < a.last; ++i)
                    for (std::uint32_t j = a.number == b.number ? i + 1 : b.first; j < b.last; ++j)
                        add(found, i, j);
            });
        std::ranges::sort(found);
        CHECK(found == expected);
    }
}

TEST_CASE(
    "a segment meets its faces in a tree, also in one whose faces all lie in a plane or at a "
    "point") {
    const Mesh mesh(make_built_in_shape("torus", 4000));
    const FaceTree tree(mesh);
    Random random(4);
    for (int round = 0; round < 200; ++round) {
        // Through the middle of a face: at least that one is found.
        const std::uint32_t face = random.below(mesh.face_count());
        glm::dvec3 middle(0.0);
        for (const VertexId v : mesh.triangles()[face])
            middle += glm::dvec3(mesh.positions()[index(v)]) / 3.0;
        const glm::dvec3 step(random.in_cube());
        CHECK(tree.any_along(middle - step, middle + step,
                             [&](std::uint32_t found) { return found == face; }));
    }
    for (const glm::vec3& extent : {glm::vec3(1, 1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, 0)}) {
        MeshSource flat;
        for (std::uint32_t f = 0; f < 3000; ++f) {
            for (int k = 0; k < 3; ++k) flat.positions.push_back(extent * random.in_cube());
            flat.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
        }
        const Mesh flat_mesh(flat);
        const FaceTree flat_tree(flat_mesh);
        std::uint32_t found = 0;
        flat_tree.any_meeting({glm::vec3(-2), glm::vec3(2)}, [&](std::uint32_t) {
            ++found;
            return false;
        });
        CHECK(found == 3000);
    }
}

TEST_CASE("segments together find the faces that each of them finds alone") {
    Random random(5);
    FaceTree::Segments segments;
    for (const std::uint32_t faces : {0u, 1u, 4u, 5u, 17u, 300u, 4000u}) {
        CAPTURE(faces);
        const Mesh mesh = scattered_faces(random, faces);
        const FaceTree tree(mesh);
        for (const std::uint32_t count : {0u, 1u, 40u}) {
            segments.clear();
            std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
            for (std::uint32_t i = 0; i < count; ++i) {
                const glm::dvec3 from(random.in_cube());
                // One along an axis, one without length.
                const glm::dvec3 way(i == 0   ? glm::vec3(0, 0, 1)
                                     : i == 1 ? glm::vec3(0)
                                              : random.in_cube());
                segments.add(from, from + way);
                tree.each_along(from, from + way,
                                [&](std::uint32_t face) { expected.emplace_back(i, face); });
            }
            segments.each_along(tree, [&](std::uint32_t segment, std::uint32_t face) {
                found.emplace_back(segment, face);
            });
            std::ranges::sort(expected);
            std::ranges::sort(found);
            CHECK(found == expected);
            if (faces == 4000 && count == 40) CHECK(found.size() > 1000);
        }
    }
}

}  // namespace
}  // namespace rimline
