#include "silhouette/hough/hough_octree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <stop_token>
#include <thread>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/rounds.h"
#include "tests/silhouette/hough/against_brute_force.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/origin_lists.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline {
namespace {

std::vector<EdgeId> extracted(const HoughOctree& octree, const HomogeneousPoint& point) {
    std::vector<EdgeId> edges{k_no_edge};  // Replaced, not appended to.
    TraversalCounters counters;
    octree.extract(point, edges, counters);
    std::sort(edges.begin(), edges.end());
    return edges;
}

TEST_CASE("extraction equals brute force on every made mesh") {
    const std::uint32_t points = 1000;
    for (const auto& [name, source] : tests::made_meshes(4000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        tests::check_extraction(HoughOctree(mesh), points, 21);
    }
}

TEST_CASE("extraction equals brute force from every origin and with several") {
    const std::uint32_t points = 60;
    for (const auto& [name, source] : tests::made_meshes(1000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        for (const std::vector<glm::dvec3>& origins : tests::origin_lists(mesh)) {
            CAPTURE(origins.size());
            CAPTURE(origins[0].x);
            tests::check_extraction(HoughOctree(mesh, {origins}), points, 22);
        }
    }
}

TEST_CASE("face words hold the bits of all faces as a point sees them") {
    for (const auto& [name, source] : tests::made_meshes(1000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const HoughOctree octree(mesh);
        BlockScratch scratch = octree.make_scratch();
        std::vector<std::uint16_t> bits(octree.block_count());
        const auto point = HomogeneousPoint::direction({0.3f, -0.7f, 0.5f});
        octree.evaluate_faces(point, bits, scratch);
        std::vector<std::uint32_t> expected(face_word_count(mesh.face_count()), 0);
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            if (is_front(mesh.plane(FaceId{f}), point)) expected[f / 32] |= 1u << f % 32;
        CHECK(octree.face_words(bits) == expected);
    }
}

TEST_CASE("every edge but borders is in exactly one place") {
    for (const auto& [name, source] : tests::made_meshes(1000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const HoughOctreeStatistics s = HoughOctree(mesh).statistics();
        CHECK(s.owned_edges + s.sfo_edges + s.undecided_edges + s.nonmanifold_edges ==
              mesh.edges_of_class(EdgeClass::border).first);
        CHECK(s.faces == mesh.face_count() - mesh.degenerate_face_count());
    }
}

TEST_CASE("the SFO edges are the silhouette from the origin") {
    for (const auto& [name, source] : tests::made_meshes(1000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        if (mesh.edges_of_class(EdgeClass::nonmanifold).size() > 0) continue;
        const glm::dvec3 origin(glm::vec3(mesh.center()));  // One that a viewpoint can be.
        const HoughOctreeStatistics s = HoughOctree(mesh, {{origin}}).statistics();
        const std::size_t seen =
            brute_force_silhouette(mesh, HomogeneousPoint::viewpoint(glm::vec3(origin))).size();
        // The face bit from there is a rounded product; the side of the origin is not. They part only
        // at planes that hold the origin within that rounding, and at those the octree calls undecided.
        if (s.undecided_edges == 0 && name != "far away") CHECK(s.sfo_edges == seen);
    }
}

TEST_CASE("faces of one plane are settled by one box") {
    MeshSource source;
    for (const auto& hard : tests::hard_meshes())
        if (hard.name == "coplanar fan") source = hard.source;
    const Mesh mesh(source);
    REQUIRE(mesh.face_count() == 10000);
    const HoughOctree octree(mesh, {{glm::dvec3(0.0)}});
    std::vector<EdgeId> edges;
    TraversalCounters counters;
    octree.extract(HomogeneousPoint::viewpoint({0.3f, 2.0f, 0.1f}), edges, counters);
    CHECK(edges.empty());
    CHECK(counters.edge_checks == 0);
}

TEST_CASE("extraction looks at a small part of a large mesh") {
    const Mesh mesh(tests::made_meshes(100000)[16].source);  // The first built-in shape: a sphere.
    REQUIRE(mesh.face_count() > 50000);
    const HoughOctree octree(mesh);
    std::vector<EdgeId> edges;
    TraversalCounters counters;
    octree.extract(HomogeneousPoint::viewpoint({2.0f, 1.5f, 0.5f}), edges, counters);
    CHECK(edges.size() > 100);
    CHECK(counters.edge_checks < mesh.edge_count() / 5);
    CHECK(counters.box_checks < mesh.face_count() / 5);
}

TEST_CASE("whenever a build is cancelled it says so, or is done") {
    // Long enough that the start of a thread takes a small part of it, on a machine with other work too.
    const Mesh mesh(make_built_in_shape("knot", 100'000));
    using Clock = std::chrono::steady_clock;
    // The shortest of several: other work on the machine must not make it seem longer than it is.
    auto build_time = Clock::duration::max();
    for (int i = 0; i < 5; ++i) {
        const Clock::time_point begun = Clock::now();
        const HoughOctree whole(mesh);
        build_time = std::min(build_time, Clock::now() - begun);
    }
    constexpr int k_builds = tests::rounds(60);
    int cancelled = 0;
    for (int i = 0; i < k_builds; ++i) {
        std::stop_source source;
        const auto moment = Clock::now() + i * build_time / k_builds;
        std::jthread stopper([&] {
            while (Clock::now() < moment) {
            }
            source.request_stop();
        });
        try {
            const HoughOctree octree(mesh, {}, {source.get_token(), {}});
            CHECK(octree.statistics().faces == mesh.face_count());
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::cancelled);
            ++cancelled;
        }
    }
    CHECK(cancelled > k_builds / 4);
}

TEST_CASE("an empty mesh has an empty silhouette") {
    const Mesh mesh{MeshSource{}};
    const HoughOctree octree(mesh);
    CHECK(octree.statistics().nodes == 0);
    CHECK(extracted(octree, HomogeneousPoint::viewpoint({1.0f, 2.0f, 3.0f})).empty());
}

TEST_CASE("find_flips names exactly the faces whose bits differ") {
    const std::uint64_t seed = 23;
    CAPTURE(seed);
    for (const auto& [name, source] : tests::made_meshes(1000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const HoughOctree octree(mesh);
        BlockScratch scratch = octree.make_scratch();
        tests::ProbePoints probes(mesh, seed);
        for (std::uint32_t i = 0; i < 100; ++i) {
            const HomogeneousPoint from = probes.next();
            const HomogeneousPoint to = probes.next();
            std::vector<std::uint16_t> bits(octree.block_count());
            octree.evaluate_faces(from, bits, scratch);
            std::vector<std::uint32_t> states(bits.begin(), bits.end());
            std::vector<FlippedBlock> blocks(octree.block_count());
            TraversalCounters counters;
            blocks.resize(octree.find_flips(from, to, states, blocks, counters, scratch));
            std::vector<FaceId> flipped;
            for (const FlippedBlock& block : blocks) {
                REQUIRE(block.lanes != 0);
                for (std::uint32_t lane = 0; lane < k_block_size; ++lane)
                    if (block.lanes >> lane & 1u)
                        flipped.push_back(octree.face_at(block.block * k_block_size + lane));
                bits[block.block] ^= static_cast<std::uint16_t>(block.lanes);
            }
            std::vector<FaceId> expected;
            for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
                if (is_front(mesh.plane(FaceId{f}), from) != is_front(mesh.plane(FaceId{f}), to))
                    expected.push_back(FaceId{f});
            std::sort(flipped.begin(), flipped.end());
            REQUIRE(flipped == expected);
            std::vector<std::uint16_t> expected_bits(octree.block_count());
            octree.evaluate_faces(to, expected_bits, scratch);
            REQUIRE(bits == expected_bits);
        }
    }
}

}  // namespace
}  // namespace rimline
