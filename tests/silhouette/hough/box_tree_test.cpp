#include "silhouette/hough/box_tree.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "silhouette/hough/block_kernels.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/origin_lists.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline {
namespace {

// Two planes a block, in the mesh's order: boxes of every shape.
struct Boxed {
    std::vector<std::array<Plane, 2>> planes;
    BoxTree tree;
    std::vector<NodeFrames> frames;
};

Boxed boxed(const Mesh& mesh, const glm::dvec3& origin) {
    Boxed boxed;
    std::vector<HoughBounds> bounds;
    for (std::uint32_t f = 0; f + 1 < mesh.face_count(); f += 2) {
        const std::array<Plane, 2> pair{mesh.plane(FaceId{f}), mesh.plane(FaceId{f + 1})};
        if (!pair[0].has_normal() || !pair[1].has_normal()) continue;
        const HoughPoint a = hough_point(pair[0], origin);
        const HoughPoint b = hough_point(pair[1], origin);
        if (a.side == 0 || b.side == 0 || a.side != b.side) continue;
        boxed.planes.push_back(pair);
        bounds.emplace_back().include(a);
        bounds.back().include(b);
    }
    boxed.tree = BoxTree(std::move(bounds));
    boxed.frames.resize(boxed.planes.size() / k_node_width + 1);
    return boxed;
}

TEST_CASE("planes of a box that is not mixed have equal bits, from every kind of point") {
    const std::uint64_t seed = 61;
    CAPTURE(seed);
    std::uint64_t settled = 0;
    std::uint64_t unequal = 0;
    for (const auto& [name, source] : tests::made_meshes(800)) {
        CAPTURE(name);
        const Mesh mesh(source);
        for (const auto& origins : tests::origin_lists(mesh)) {
            const Boxed boxes = boxed(mesh, origins[0]);
            if (boxes.planes.empty()) continue;
            BlockScratch scratch(boxes.tree.block_count());
            tests::ProbePoints probes(mesh, seed);
            for (std::uint32_t i = 0; i < 100; ++i) {
                const HomogeneousPoint p = probes.next();
                std::uint64_t nodes = 0;
                const std::uint32_t count = kernels::find_mixed(
                    boxes.tree, boxes.frames, BoxQuery(p, origins[0], boxes.tree.max_reach()),
                    BlockPoint(p, origins[0], 1.0), kernels::SettledBy::box, scratch, nodes);
                std::vector<bool> is_mixed(boxes.planes.size(), false);
                for (std::uint32_t j = 0; j < count; ++j) {
                    REQUIRE(scratch.block[j] < boxes.planes.size());
                    REQUIRE_FALSE(is_mixed[scratch.block[j]]);
                    is_mixed[scratch.block[j]] = true;
                }
                for (std::size_t b = 0; b < boxes.planes.size(); ++b) {
                    const bool differ =
                        is_front(boxes.planes[b][0], p) != is_front(boxes.planes[b][1], p);
                    unequal += differ;
                    settled += !is_mixed[b];
                    if (!is_mixed[b]) REQUIRE_FALSE(differ);
                }
            }
        }
    }
    CHECK(settled > 1000000);
    CHECK(unequal > 100000);
}

TEST_CASE("every depth of tree holds every block once") {
    const HoughPoint at{{1.0, 0.0, 0.0}, 1e-9, 1};
    for (const std::uint32_t count : {0u, 1u, 7u, 8u, 9u, 64u, 65u, 511u, 513u, 5000u}) {
        CAPTURE(count);
        std::vector<HoughBounds> bounds(count);
        for (HoughBounds& box : bounds) box.include(at);
        const BoxTree tree(std::move(bounds));
        CHECK(tree.block_count() == count);
        std::vector<NodeFrames> frames(count / k_node_width + 1);
        BlockScratch scratch(count);
        // The v-sphere of this viewpoint runs through the point.
        const HomogeneousPoint p = HomogeneousPoint::viewpoint({1.0f, 2.0f, 0.0f});
        std::uint64_t nodes = 0;
        REQUIRE(kernels::find_mixed(tree, frames, BoxQuery(p, glm::dvec3(0.0), tree.max_reach()),
                                    BlockPoint(p, glm::dvec3(0.0), 1.0), kernels::SettledBy::box,
                                    scratch, nodes) == count);
        for (std::uint32_t b = 0; b < count; ++b) REQUIRE(scratch.block[b] == b);
        CHECK(nodes == tree.node_count());
    }
}

}  // namespace
}  // namespace rimline
