#include "silhouette/hough/block_tree.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "silhouette/hough/block_kernels.h"
#include "tests/rounds.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/origin_lists.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline {
namespace {

// One or two planes a block, in the mesh's order: boxes of every shape, many of them flat.
struct Boxed {
    BlockSpace space;
    std::vector<std::vector<Plane>> planes;
    BlockTree tree;

    Boxed(const Mesh& mesh, const glm::dvec3& origin, std::uint32_t a_block)
        : space{origin, 0x1p-400} {
        for (const Plane& plane : mesh.planes()) {
            const glm::dvec3 n = plane.normal();
            space.length =
                std::max(space.length, 1.00001 * std::abs(double{plane.d} - glm::dot(n, origin)));
        }
        std::vector<BlockBounds> bounds;
        for (std::uint32_t f = 0; f + a_block <= mesh.face_count(); f += a_block) {
            planes.emplace_back();
            bounds.emplace_back();
            for (std::uint32_t i = f; i < f + a_block; ++i) {
                planes.back().push_back(mesh.plane(FaceId{i}));
                bounds.back().include(space.vector_of(planes.back().back()));
            }
        }
        tree = BlockTree(bounds);
    }
};

// Of the blocks that are not mixed, the wrong bits: those that are not what the rest of the block has, or, of a
// block of one plane, not the sign of its center.
struct Verdict {
    std::uint64_t settled = 0;
    std::uint64_t wrong = 0;

    void add(const Boxed& boxes, const HomogeneousPoint& p, const BlockPoint& point) {
        BlockScratch scratch(boxes.tree.block_count());
        std::uint64_t nodes = 0;
        const std::uint32_t count = kernels::find_mixed(boxes.tree, point, scratch, nodes);
        std::vector<bool> is_mixed(boxes.planes.size(), false);
        for (std::uint32_t j = 0; j < count; ++j) {
            REQUIRE(scratch.block[j] < boxes.planes.size());
            REQUIRE_FALSE(is_mixed[scratch.block[j]]);
            is_mixed[scratch.block[j]] = true;
        }
        const std::span<const BlockNode> level = boxes.tree.last_level();
        for (std::size_t b = 0; b < boxes.planes.size(); ++b) {
            if (is_mixed[b]) continue;
            const std::size_t lane = 2 * (b % k_node_width);
            const BlockNode& node = level[b / k_node_width];
            const std::int32_t value = node.center_xy[lane] * point.weights[0] +
                                       node.center_xy[lane + 1] * point.weights[1] +
                                       node.center_zd[lane] * point.weights[2] +
                                       node.center_zd[lane + 1] * point.weights[3];
            for (const Plane& plane : boxes.planes[b]) {
                ++settled;
                wrong += is_front(plane, p) != (value > 0);
            }
        }
    }
};

TEST_CASE("the bits of a box that is not mixed are those of its center, from every kind of point") {
    const std::uint64_t seed = 61;
    CAPTURE(seed);
    Verdict whole;
    Verdict without_margin;
    for (const auto& [name, source] : tests::made_meshes(800)) {
        CAPTURE(name);
        const Mesh mesh(source);
        for (const auto& origins : tests::origin_lists(mesh)) {
            for (const std::uint32_t a_block : {1u, 2u}) {
                const Boxed boxes(mesh, origins[0], a_block);
                if (boxes.planes.empty()) continue;
                tests::ProbePoints probes(mesh, seed);
                for (std::uint32_t i = 0; i < tests::rounds(50u); ++i) {
                    const HomogeneousPoint p = probes.next();
                    BlockPoint point = boxes.space.seen_from(p);
                    whole.add(boxes, p, point);
                    REQUIRE(whole.wrong == 0);
                    point.box_margin = 0;
                    without_margin.add(boxes, p, point);
                }
            }
        }
    }
    CHECK(whole.settled > tests::rounds(1000000u));
    CHECK(without_margin.wrong > tests::rounds(100u));
}

TEST_CASE("between two points, blocks that are neither mixed nor certain keep their bits") {
    const std::uint64_t seed = 62;
    CAPTURE(seed);
    std::uint64_t kept_count = 0;
    std::uint64_t flipped_count = 0;
    std::uint64_t wrong_without_margin = 0;
    for (const auto& [name, source] : tests::made_meshes(800)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const Boxed boxes(mesh, mesh.center(), 1);
        if (boxes.planes.empty()) continue;
        BlockScratch scratch(boxes.tree.block_count());
        tests::ProbePoints probes(mesh, seed);
        for (std::uint32_t i = 0; i < tests::rounds(200u); ++i) {
            const HomogeneousPoint from = probes.next();
            const HomogeneousPoint to = probes.next();
            enum class Is : std::uint8_t { kept, mixed, flipped };
            const auto sort_blocks = [&](bool with_margin) {
                BlockPoint a = boxes.space.seen_from(from);
                BlockPoint b = boxes.space.seen_from(to);
                if (!with_margin) a.box_margin = b.box_margin = 0;
                std::uint64_t nodes = 0;
                std::uint32_t certain = 0;
                const std::uint32_t count =
                    kernels::find_changing(boxes.tree, a, b, scratch, certain, nodes);
                std::vector<Is> is(boxes.planes.size(), Is::kept);
                for (std::uint32_t j = 0; j < count; ++j) is[scratch.block[j]] = Is::mixed;
                for (std::uint32_t j = 0; j < certain; ++j)
                    for (std::uint32_t block = scratch.certain[j].first;
                         block < scratch.certain[j].last; ++block) {
                        REQUIRE(is[block] == Is::kept);
                        is[block] = Is::flipped;
                    }
                return is;
            };
            const std::vector<Is> is = sort_blocks(true);
            const std::vector<Is> without = sort_blocks(false);
            for (std::size_t block = 0; block < is.size(); ++block) {
                const Plane& plane = boxes.planes[block][0];
                const bool differ = is_front(plane, from) != is_front(plane, to);
                if (is[block] == Is::kept) {
                    REQUIRE_FALSE(differ);
                    ++kept_count;
                }
                if (is[block] == Is::flipped) {
                    REQUIRE(differ);
                    ++flipped_count;
                }
                wrong_without_margin += without[block] == (differ ? Is::kept : Is::flipped);
            }
        }
    }
    CHECK(kept_count > tests::rounds(100000u));
    CHECK(flipped_count > tests::rounds(100000u));
    CHECK(wrong_without_margin > tests::rounds(100u));
}

TEST_CASE("where floats say nothing of a box of all planes, nothing is certain from two points") {
    BlockBounds all;
    all.include(PlaneVector{-1.0, -1.0, -1.0, -1.0});
    all.include(PlaneVector{1.0, 1.0, 1.0, 1.0});
    const BlockTree tree(std::span(&all, 1));
    const HomogeneousPoint p = HomogeneousPoint::viewpoint({1.0f, 0.0f, 0.0f});
    BlockPoint from(p, glm::dvec3(0.0), 1.0);
    BlockPoint to = from;
    from.weights = {32000, 0, 0, 0};
    to.weights = {0, 18475, 18475, 18475};
    BlockScratch scratch(1);
    for (const std::int32_t margin : {0, 1 << 20, 1 << 29, 1 << 30}) {
        CAPTURE(margin);
        from.box_margin = to.box_margin = margin;
        std::uint64_t nodes = 0;
        std::uint32_t certain = 0;
        CHECK(kernels::find_changing(tree, from, to, scratch, certain, nodes) == 1);
        CHECK(certain == 0);
        CHECK(kernels::find_mixed(tree, to, scratch, nodes) == 1);
    }
}

TEST_CASE("every depth of tree holds every block once") {
    for (const std::uint32_t count : {0u, 1u, 7u, 8u, 9u, 64u, 65u, 511u, 513u, 5000u}) {
        CAPTURE(count);
        std::vector<BlockBounds> bounds(count);
        for (BlockBounds& box : bounds) box.include(PlaneVector{1.0, 0.0, 0.0, 1.0});
        const BlockTree tree(bounds);
        CHECK(tree.block_count() == count);
        BlockScratch scratch(count);
        // It lies in the plane.
        const HomogeneousPoint p = HomogeneousPoint::viewpoint({1.0f, 2.0f, 0.0f});
        std::uint64_t nodes = 0;
        REQUIRE(kernels::find_mixed(tree, BlockPoint(p, glm::dvec3(0.0), 1.0), scratch, nodes) ==
                count);
        for (std::uint32_t b = 0; b < count; ++b) REQUIRE(scratch.block[b] == b);
        CHECK(nodes == tree.node_count());
    }
}

}  // namespace
}  // namespace rimline
